#include "formats/brlcad/shader_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

namespace graycube::brlcad {
namespace {

/// What both shaders take.
struct Parameters {
  NoiseOctaves octaves;
  /// The side of the largest blobs, in mm, if it isn't 1; else those along the axes count.
  double size = 1;
  Vec3 sizes;
  /// Added in the noise's coordinates: noise is mirrored at the planes of its axes, far from there.
  Vec3 delta{1000, 1000, 1000};
  std::array<double, 2> thresholds;
  std::array<Rgb, 3> colors;
};

constexpr Parameters kCamo{.octaves = {},
                           .sizes = {0.0125, 0.0125, 0.0125},
                           .thresholds = {-0.25, 0.25},
                           .colors = {{{0.38, 0.29, 0.16}, {0.1, 0.3, 0.04}, {0.15, 0.15, 0.15}}}};
constexpr Parameters kMarble{.octaves = {},
                             .sizes = {1, 1, 1},
                             .thresholds = {0.25, 0.5},
                             .colors = {{{0.8, 0.2, 0.16}, {0.9, 0.9, 0.8}, {0.15, 0.15, 0.15}}}};

void read_number(std::string_view key, double value, Parameters& p) {
  if ((key == "l" || key == "lacunarity") && value > 0) p.octaves.lacunarity = value;
  if (key == "H") p.octaves.decay = value;
  if (key == "o" || key == "octaves") p.octaves.count = std::clamp(value, 0.0, kMaxOctaves);
  if (key == "t1") p.thresholds[0] = value;
  if (key == "t2") p.thresholds[1] = value;
  if ((key == "s" || key == "size") && value != 0) p.size = value;
}

void read_vector(std::string_view key, const Vec3& value, Parameters& p) {
  const bool is_sizes = key == "v" || key == "vs" || key == "vscale";
  if (is_sizes && value.x != 0 && value.y != 0 && value.z != 0) p.sizes = value;
  if (key == "d" || key == "delta") p.delta = value;
  if (key == "c1") p.colors[0] = unit_color(value);
  if (key == "c2") p.colors[1] = unit_color(value);
  if (key == "c3") p.colors[2] = unit_color(value);
}

/// A colour 0 … 255; rt reads whole numbers.
Rgb byte_color(const Vec3& v) {
  const auto unit = [](double c) { return std::clamp(std::trunc(c), 0.0, 255.0) / 255; };
  return {unit(v.x), unit(v.y), unit(v.z)};
}

Pattern checker_of(const ShaderWords& words) {
  Pattern pattern;
  pattern.kind = PatternKind::kChecker;
  // How many squares lie along u and v from 0 to 1.
  double scale = 2;
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const auto color = vector_behind(words, i);
    if (words[i] == "a" && color) pattern.colors[0] = byte_color(*color);
    if (words[i] == "b" && color) pattern.colors[1] = byte_color(*color);
    if (words[i] == "s") scale = std::fabs(number_behind(words, i).value_or(scale));
  }
  pattern.to_pattern = scaling({scale, scale, 1});
  const bool is_plain = pattern.colors[0] == pattern.colors[1] || !pattern.to_pattern.inverse();
  if (is_plain) pattern.kind = PatternKind::kNone;
  return pattern;
}

Pattern clouds_of(const ShaderWords& words) {
  Pattern pattern;
  pattern.kind = PatternKind::kClouds;
  pattern.colors[0] = {0.31, 0.31, 0.78};
  pattern.thresholds = {0.35, 0.3};
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const auto value = number_behind(words, i);
    if (words[i] == "thresh" && value) pattern.thresholds[0] = *value;
    if (words[i] == "range" && value) pattern.thresholds[1] = *value;
  }
  return pattern;
}

/// Red goes with u and blue with v.
Pattern testmap() {
  Pattern pattern;
  pattern.kind = PatternKind::kGradient;
  pattern.colors = {{{1, 0, 0}, {0, 0, 1}, {0, 0, 0}}};
  return pattern;
}

}  // namespace

std::optional<Pattern> pattern_on_solids_of(const ShaderWords& words) {
  if (words.empty()) return std::nullopt;
  if (words.front() == "checker") return checker_of(words);
  if (words.front() == "cloud") return clouds_of(words);
  if (words.front() == "testmap") return testmap();
  return std::nullopt;
}

std::optional<Pattern> pattern_of(const ShaderWords& words) {
  const bool is_camo = words.front() == "camo";
  if (!is_camo && words.front() != "marble") return std::nullopt;
  Parameters p = is_camo ? kCamo : kMarble;
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    if (const auto value = number_behind(words, i)) read_number(words[i], *value, p);
    if (const auto value = vector_behind(words, i)) read_vector(words[i], *value, p);
  }
  Pattern pattern;
  pattern.octaves = p.octaves;
  const Vec3 sizes = p.size != 1 ? Vec3{p.size, p.size, p.size} : p.sizes;
  pattern.to_pattern =
      compose(translation(p.delta), scaling({1 / sizes.x, 1 / sizes.y, 1 / sizes.z}));
  if (is_camo) {
    pattern.kind = PatternKind::kCamouflage;
    pattern.thresholds = p.thresholds;
    pattern.colors = p.colors;
  } else {
    pattern.kind = PatternKind::kMarble;
    pattern.colors[0] = p.colors[1];
  }
  return pattern;
}

}  // namespace graycube::brlcad
