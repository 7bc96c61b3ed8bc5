#include "space/light_horizons.hpp"

#include <algorithm>
#include <limits>

#include "space/light_view.hpp"

namespace graycube {

LightHorizons LightHorizons::of(const Model& model) {
  const auto& lights = model.settings.lights;
  if (lights.size() * model.objects.size() > kMaxWork) return {};
  std::vector<Map> maps;
  std::vector<Sight> seen;
  for (const PointLight& light : lights) {
    Map& map = maps.emplace_back(kTexels, std::numeric_limits<float>::infinity());
    const LightView view(model, light.position);
    for (const Object& object : model.objects) {
      seen.clear();
      view.look_at(object, seen);
      for (const Sight& s : seen) map[s.texel] = std::min(map[s.texel], s.begin);
    }
  }
  return without_useless(std::move(maps));
}

LightHorizons LightHorizons::without_useless(std::vector<Map> maps) {
  for (Map& map : maps) {
    if (std::none_of(map.begin(), map.end(), [](float distance) { return distance > 0; })) map.clear();
  }
  return LightHorizons(std::move(maps));
}

bool LightHorizons::is_empty() const {
  return std::all_of(maps_.begin(), maps_.end(), [](const Map& m) { return m.empty(); });
}

}  // namespace graycube
