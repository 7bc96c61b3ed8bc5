#include "space/light_horizons.hpp"

#include <algorithm>
#include <limits>

#include "space/light_view.hpp"

namespace graycube {
namespace {

/// Distances in units are given this much shorter, relatively, before they are rounded down.
constexpr double kRelativeError = 1e-9;

}  // namespace

LightHorizons LightHorizons::of(const Model& model) {
  const auto& lights = model.settings.lights;
  if (lights.size() * model.objects.size() > kMaxWork) return {};
  std::vector<HorizonMap> maps;
  std::vector<float> distances;
  std::vector<Sight> seen;
  for (const PointLight& light : lights) {
    distances.assign(kTexels, std::numeric_limits<float>::infinity());
    const LightView view(model, light.position);
    for (const Object& object : model.objects) {
      seen.clear();
      view.look_at(object, seen);
      for (const Sight& s : seen) distances[s.texel] = std::min(distances[s.texel], s.begin);
    }
    maps.push_back(HorizonMap::of(distances));
  }
  return LightHorizons(std::move(maps));
}

HorizonMap HorizonMap::of(std::span<const float> distances) {
  constexpr float kMost = std::numeric_limits<float>::max();
  float farthest = 0, most = 0;
  for (const float d : distances) {
    most = std::max(most, d);
    farthest = std::max(farthest, d <= kMost ? d : 0);
  }
  if (!(most > 0)) return {};
  // No finite distance is so many units long that it would count as none, and no product is longer than what it is of.
  HorizonMap map{std::max<double>(farthest, std::numeric_limits<float>::min()) / (kNever - 1), {}};
  map.units.resize(distances.size());
  const double units_per_length = (1 - kRelativeError) / map.unit;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double d = distances[i];
    map.units[i] = d <= kMost ? static_cast<std::uint16_t>(d * units_per_length) : kNever;
  }
  return map;
}

bool LightHorizons::is_empty() const {
  return std::all_of(maps_.begin(), maps_.end(), [](const HorizonMap& m) { return m.empty(); });
}

}  // namespace graycube
