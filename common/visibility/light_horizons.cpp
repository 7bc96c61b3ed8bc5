#include "visibility/light_horizons.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/infinity.hpp"
#include "stop_point.hpp"
#include "visibility/light_view.hpp"

namespace graycube {
namespace {

/// Distances in units are given this much shorter, relatively, before they are rounded down: more
/// than rounding them to floats (LightHorizons::distances_at) can make of them.
constexpr double kRelativeError = 1e-6;

/// The reach, in units of the nearest distance, when no object is bounded.
constexpr double kReachOfNearest = 100;

}  // namespace

LightHorizons LightHorizons::of(const Model& model) {
  const auto& lights = model.settings.lights;
  if (lights.size() * model.objects.size() > kMaxWork) return {};
  std::vector<HorizonMap> maps;
  std::vector<float> distances;
  std::vector<Sight> seen;
  for (const PointLight& light : lights) {
    distances.assign(kTexels, kFloatInf);
    const LightView view(model, light.position);
    for (const Object& object : model.objects) {
      if (!light.shadows) break;
      stop_if_asked();
      seen.clear();
      view.look_at(object, seen);
      for (const Sight& s : seen) distances[s.texel] = std::min(distances[s.texel], s.begin);
    }
    maps.push_back(HorizonMap::of(distances, reach_of(model, light)));
  }
  return LightHorizons(std::move(maps));
}

HorizonMap HorizonMap::of(std::span<const float> distances, double reach) {
  if (std::none_of(distances.begin(), distances.end(), [](float d) { return d > 0; })) return {};
  if (reach == 0) {
    double nearest = std::numeric_limits<float>::max();
    for (const float d : distances) nearest = d > 0 ? std::min<double>(nearest, d) : nearest;
    reach = kReachOfNearest * nearest;
  }
  // No product of unit and units is longer than the distance that it stands for.
  HorizonMap map{reach / (kNever - 1), {}};
  map.units.resize(distances.size());
  const double units_per_length = (1 - kRelativeError) / map.unit;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double d = distances[i];
    const bool is_never = d > std::numeric_limits<float>::max();
    map.units[i] =
        is_never ? kNever : static_cast<std::uint16_t>(std::min(d, reach) * units_per_length);
  }
  return map;
}

double LightHorizons::reach_of(const Model& model, const PointLight& light) {
  double reach = 0;
  for (const Object& object : model.objects) {
    const Vec3 lo = object.bounds.lo - light.position, hi = object.bounds.hi - light.position;
    const Vec3 far{larger(std::fabs(lo.x), std::fabs(hi.x)),
                   larger(std::fabs(lo.y), std::fabs(hi.y)),
                   larger(std::fabs(lo.z), std::fabs(hi.z))};
    const double distance = length(far);
    if (std::isfinite(distance)) reach = std::max(reach, distance);
  }
  return reach;
}

bool LightHorizons::is_empty() const {
  return std::all_of(maps_.begin(), maps_.end(), [](const HorizonMap& m) { return m.empty(); });
}

}  // namespace graycube
