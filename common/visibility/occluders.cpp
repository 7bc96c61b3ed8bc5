#include "visibility/occluders.hpp"

#include <algorithm>

#include "geometry/infinity.hpp"
#include "stop_point.hpp"
#include "visibility/light_view.hpp"

namespace graycube {

Occluders Occluders::of(const Model& model) {
  struct Place {
    std::uint32_t texel;
    Entry entry;
  };
  const auto& lights = model.settings.lights;
  if (lights.size() * model.objects.size() > LightHorizons::kMaxWork) return {};
  Occluders all;
  all.objects_ = model.objects.size();
  std::vector<Sight> seen;
  std::vector<Place> places;
  std::size_t count = 0;
  for (const PointLight& light : lights) {
    const LightView view(model, light.position);
    places.clear();
    OfLight& l = all.lights_.emplace_back();
    l.reach = LightHorizons::reach_of(model, light);
    l.first.assign(LightHorizons::kTexels + 1, 0);
    for (std::uint32_t object = 0; object < model.objects.size(); ++object) {
      if (!light.shadows) break;
      stop_if_asked();
      seen.clear();
      view.look_at(model.objects[object], seen);
      count += seen.size();
      if (count > kMostEntries) return {};
      for (const Sight& s : seen) {
        places.push_back({s.texel, {s.begin, object}});
        ++l.first[s.texel + 1];
      }
    }
    for (std::size_t texel = 0; texel < LightHorizons::kTexels; ++texel)
      l.first[texel + 1] += l.first[texel];
    std::vector<std::uint32_t> next(l.first.begin(), l.first.end() - 1);
    l.entries.resize(places.size());
    for (const Place& p : places) l.entries[next[p.texel]++] = p.entry;
    for (std::size_t texel = 0; texel < LightHorizons::kTexels; ++texel) {
      std::sort(l.entries.begin() + l.first[texel], l.entries.begin() + l.first[texel + 1],
                [](const Entry& a, const Entry& b) { return a.begin < b.begin; });
    }
  }
  return all;
}

std::vector<std::vector<float>> Occluders::foreign_distances(
    const std::vector<bool>& is_held) const {
  std::vector<std::vector<float>> distances;
  for (const OfLight& l : lights_) {
    auto& of_light = distances.emplace_back(LightHorizons::kTexels, kFloatInf);
    for (std::size_t texel = 0; texel < LightHorizons::kTexels; ++texel) {
      std::uint32_t i = l.first[texel];
      const std::uint32_t end = l.first[texel + 1];
      while (i < end && is_held[l.entries[i].object]) ++i;
      if (i < end) of_light[texel] = l.entries[i].begin;
    }
  }
  return distances;
}

LightHorizons Occluders::horizons() const {
  std::vector<HorizonMap> maps;
  const auto distances = foreign_distances(std::vector<bool>(objects_));
  for (std::size_t light = 0; light < lights_.size(); ++light) {
    maps.push_back(HorizonMap::of(distances[light], lights_[light].reach));
  }
  return LightHorizons(std::move(maps));
}

LightHorizons Occluders::foreign_horizons(const ModelContents& contents, const Model& model) const {
  auto distances = foreign_distances(contents.is_whole);
  const Model parts = extract(model, {std::vector<bool>(objects_), contents.parts});
  std::vector<HorizonMap> maps;
  std::vector<Sight> seen;
  for (std::size_t light = 0; light < lights_.size(); ++light) {
    const LightView view(parts, model.settings.lights[light].position);
    for (const Object& part : parts.objects) {
      seen.clear();
      // A pruned tree lies within the object's bounds: only complements can be dropped from a
      // conjunction.
      view.look_at(part, seen);
      for (const Sight& s : seen)
        distances[light][s.texel] = std::min(distances[light][s.texel], s.begin);
    }
    maps.push_back(HorizonMap::of(distances[light], lights_[light].reach));
  }
  return LightHorizons(std::move(maps));
}

void choose_occluders(const Occluders& occluders, std::span<const OccluderQuery> queries,
                      std::span<const std::size_t> bytes, std::size_t room,
                      std::vector<bool>& is_held) {
  // A ray is finished only if all its objects are held, so each of these gets a share of its worth.
  std::vector<double> worth(is_held.size());
  std::vector<std::uint32_t> wanted, missing;
  for (const OccluderQuery& q : queries) {
    missing.clear();
    for (const Occluders::Entry& e : occluders.at(q.light, q.texel)) {
      if (e.begin >= q.distance) break;
      if (!is_held[e.object]) missing.push_back(e.object);
    }
    for (const std::uint32_t object : missing) {
      if (worth[object] == 0) wanted.push_back(object);
      worth[object] += q.rays / static_cast<double>(missing.size());
    }
  }
  for (const std::uint32_t object : wanted) worth[object] /= static_cast<double>(bytes[object]);
  std::sort(wanted.begin(), wanted.end(), [&](std::uint32_t a, std::uint32_t b) {
    return worth[a] != worth[b] ? worth[a] > worth[b] : a < b;
  });
  for (const std::uint32_t object : wanted) {
    if (bytes[object] > room) continue;
    room -= bytes[object];
    is_held[object] = true;
  }
}

}  // namespace graycube
