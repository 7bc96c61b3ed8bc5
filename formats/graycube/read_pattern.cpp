#include "formats/graycube/read_pattern.hpp"

#include <array>
#include <string>

#include "formats/graycube/read_transform.hpp"
#include "formats/graycube/scene_words.hpp"
#include "spelling.hpp"

namespace graycube {
namespace {

enum Key : std::size_t {
  kType,
  kColors,
  kToPattern,
  kThresholds,
  kOctaves,
  kLacunarity,
  kDecay,
  kChart,
  kKeys
};
constexpr std::array<KeyRule, kKeys> kRules{{{"type", true},
                                             {"colors", true},
                                             {"to_pattern"},
                                             {"thresholds"},
                                             {"octaves"},
                                             {"lacunarity"},
                                             {"decay"},
                                             {"chart"}}};
constexpr NumberRule kOctaveCount{.what = "a number from 0 to 32", .min = 0, .max = kMaxOctaves};

bool is_list_of(JsonAccess& json, JsonIndex at, std::size_t count, const std::string& what) {
  if (json.tree.kind(at) == JsonKind::kArray && json.tree.size(at) == count) return true;
  return json.wrong(at, what);
}

void read_colors(JsonAccess& json, JsonIndex at, Pattern& out) {
  const std::size_t count = colors_of(out.kind);
  if (!is_list_of(json, at, count,
                  "a list of " + std::to_string(count) + (count == 1 ? " colour" : " colours")))
    return;
  JsonIndex color = json.tree.first_child(at);
  for (std::size_t i = 0; i < count; ++i, color = json.tree.next(color))
    json.read(color, out.colors[i]);
}

void read_thresholds(JsonAccess& json, JsonIndex at, std::array<double, 2>& out) {
  if (!is_list_of(json, at, 2, "two numbers")) return;
  const JsonIndex first = json.tree.first_child(at);
  json.read(first, out[0]);
  json.read(json.tree.next(first), out[1]);
}

bool has_key(PatternKind kind, std::size_t key) {
  if (key == kThresholds) return has_thresholds(kind);
  return key < kOctaves || key == kChart || has_noise(kind);
}

enum ChartKey : std::size_t { kChartType, kToSolid, kFaceMaps, kEnds, kTopRadii, kChartKeys };
constexpr std::array<KeyRule, kChartKeys> kChartRules{
    {{"type", true}, {"to_solid"}, {"faces"}, {"ends"}, {"top_radii"}}};

bool has_key(ChartKind kind, std::size_t key) {
  if (key == kFaceMaps) return kind == ChartKind::kFaces;
  if (key == kToSolid) return kind != ChartKind::kFaces;
  return key == kChartType || kind == ChartKind::kRound;
}

/// Reads a map, or the identity of an empty list.
Affine read_map(JsonAccess& json, JsonIndex at) {
  return read_transform(json, at).value_or(Affine{});
}

void read_face_maps(JsonAccess& json, JsonIndex chart, JsonIndex at, Chart& out) {
  const std::string what = "a list of 1 to " + std::to_string(kMaxChartFaces) + " faces' maps";
  out.maps.clear();
  const bool is_list = at != 0 && json.tree.kind(at) == JsonKind::kArray;
  const std::size_t count = is_list ? json.tree.size(at) : 0;
  if (count < 1 || count > kMaxChartFaces) {
    json.wrong(at == 0 ? chart : at, what);
    return;
  }
  JsonIndex face = json.tree.first_child(at);
  for (std::size_t i = 0; i < count; ++i, face = json.tree.next(face))
    out.maps.push_back(read_map(json, face));
}

void read_round(JsonAccess& json, JsonIndex ends, JsonIndex radii, Chart& out) {
  if (ends != 0 && is_list_of(json, ends, 2, "what v is on both ends")) {
    JsonIndex end = json.tree.first_child(ends);
    for (std::size_t i = 0; i < 2; ++i, end = json.tree.next(end))
      json.read_word(end, out.ends[i], kEndChartWords);
  }
  if (radii != 0 && is_list_of(json, radii, 2, "two radii")) {
    const JsonIndex first = json.tree.first_child(radii);
    json.read(first, out.top_radii[0], kNotNegative);
    json.read(json.tree.next(first), out.top_radii[1], kNotNegative);
  }
}

void read_chart(JsonAccess& json, JsonIndex at, Chart& out) {
  std::array<JsonIndex, kChartKeys> member{};
  json.members(at, "a chart", kChartRules, member);
  if (member[kChartType] == 0 || !json.read_word(member[kChartType], out.kind, kChartWords)) return;
  for (std::size_t key = 0; key < kChartKeys; ++key) {
    if (member[key] == 0 || has_key(out.kind, key)) continue;
    json.errors.add(member[key], "a " + std::string(word_of(kChartWords, out.kind)) +
                                     " chart has no key " + quoted(kChartRules[key].name));
  }
  out.maps = {member[kToSolid] == 0 ? Affine{} : read_map(json, member[kToSolid])};
  if (out.kind == ChartKind::kFaces) read_face_maps(json, at, member[kFaceMaps], out);
  read_round(json, member[kEnds], member[kTopRadii], out);
}

}  // namespace

void read_pattern(JsonAccess& json, JsonIndex at, Pattern& out) {
  std::array<JsonIndex, kKeys> member{};
  json.members(at, "a pattern", kRules, member);
  if (member[kType] == 0 || !json.read_word(member[kType], out.kind, kPatternWords)) return;
  for (std::size_t key = 0; key < kKeys; ++key) {
    if (member[key] == 0 || has_key(out.kind, key)) continue;
    json.errors.add(member[key], "a " + std::string(word_of(kPatternWords, out.kind)) +
                                     " pattern has no key " + quoted(kRules[key].name));
  }
  if (member[kColors] != 0) read_colors(json, member[kColors], out);
  if (member[kThresholds] != 0) read_thresholds(json, member[kThresholds], out.thresholds);
  json.read_optional(member[kOctaves], out.octaves.count, kOctaveCount);
  json.read_optional(member[kLacunarity], out.octaves.lacunarity, kPositive);
  json.read_optional(member[kDecay], out.octaves.decay);
  if (member[kToPattern] != 0) out.to_pattern = read_map(json, member[kToPattern]);
  if (member[kChart] != 0) read_chart(json, member[kChart], out.chart);
}

}  // namespace graycube
