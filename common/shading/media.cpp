#include "shading/media.hpp"

#include <algorithm>

#include "check.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {

Media::Media(std::span<const Material> materials) {
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (!attenuates(materials[i])) continue;
    materials_.push_back(static_cast<std::uint32_t>(i));
    attenuation_.push_back(materials[i].optics.attenuation);
  }
  GRAYCUBE_CHECK(materials_.size() <= kMaxMedia, "%zu media", materials_.size());
}

Medium Media::of(std::uint32_t material) const {
  const auto at = std::lower_bound(materials_.begin(), materials_.end(), material);
  if (at == materials_.end() || *at != material) return 0;
  return static_cast<Medium>(at - materials_.begin() + 1);
}

Rgb Media::left_after(Medium medium, double distance) const {
  GRAYCUBE_CHECK(medium > 0 && medium <= count(), "medium %u of %zu", medium, count());
  const auto left = [distance](double a) { return a == 0 ? 1 : portable_exp(-a * distance); };
  const Rgb& a = attenuation_[medium - 1];
  return {left(a.r), left(a.g), left(a.b)};
}

}  // namespace graycube
