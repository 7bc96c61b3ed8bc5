// Light horizons: for each light, a cube map of the least distance at which any surface of the scene may begin
// in that direction (design section 10). A shadow ray that is nearer to its light than that meets nothing more,
// whatever process holds the space between: it needs no walk and no message.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "csg/model.hpp"

namespace graycube {

class LightHorizons {
 public:
  /// Texels along a side of a face.
  static constexpr std::uint32_t kSide = 64;
  static constexpr std::size_t kTexels = std::size_t{6} * kSide * kSide;
  /// Lights × objects beyond which looking for horizons costs more than it is likely to save.
  static constexpr std::uint64_t kMaxWork = 2'000'000;
  using Map = std::vector<float>;

  LightHorizons() = default;
  /// By light; a map has kTexels distances ≥ 0, or none: that light has no horizon.
  explicit LightHorizons(std::vector<Map> maps) : maps_(std::move(maps)) {}
  /// Of a whole model. A light that something surrounds so closely that its map would be useless gets none.
  static LightHorizons of(const Model& model);

  const std::vector<Map>& maps() const { return maps_; }
  /// True when no light has a map.
  bool is_empty() const;

  /// No surface is nearer to the light than this in that direction from it (unit); 0 when nothing is known.
  double distance(std::size_t light, const Vec3& direction) const {
    if (light >= maps_.size() || maps_[light].empty()) return 0;
    return static_cast<double>(maps_[light][texel_of(direction)]);
  }
  static std::size_t texel_of(const Vec3& direction);

 private:
  std::vector<Map> maps_;
};

}  // namespace graycube
