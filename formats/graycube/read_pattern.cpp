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
  kKeys
};
constexpr std::array<KeyRule, kKeys> kRules{{{"type", true},
                                             {"colors", true},
                                             {"to_pattern"},
                                             {"thresholds"},
                                             {"octaves"},
                                             {"lacunarity"},
                                             {"decay"}}};
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
  if (key == kThresholds) return kind == PatternKind::kCamouflage;
  return key < kOctaves || has_noise(kind);
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
  if (member[kToPattern] == 0) return;
  if (const auto map = read_transform(json, member[kToPattern])) out.to_pattern = *map;
}

}  // namespace graycube
