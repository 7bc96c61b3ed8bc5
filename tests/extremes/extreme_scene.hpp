// Scenes whose numbers are extreme, from a seed: those of a random scene, some of them replaced or
// all of them scaled, and maps that are nearly singular.
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>

#include "csg/random_model.hpp"
#include "extremes/extreme_numbers.hpp"
#include "formats/graycube/write_scene.hpp"

namespace graycube::testing {

/// Writes random scenes as text, and makes their numbers extreme on the way.
class ExtremeScene {
 public:
  explicit ExtremeScene(std::uint64_t seed) : seed_(seed), dice_(seed ^ 0xE87E3Eull) {}

  /// A scene file that may be refused, as the numbers come.
  std::string text() {
    RandomOptions options;
    options.max_objects = 3;
    options.max_tree_depth = 2;
    Scene scene = RandomModel(seed_, options).scene();
    scene.settings.image = {12, 8, 1};
    scene.settings.max_depth = 3;
    if (dice_.one_in(4)) scene.objects.push_back({"prism", 0, prism()});
    choose_changes();
    return with_maps(with_numbers(write_scene_text(scene)));
  }

 private:
  /// A polygon with a hole, whose pieces a difference holds.
  CsgNode prism() {
    PrismShape shape;
    shape.points = {{0, 0}, {3, 0}, {3, 2}, {2, 0.5}, {0, 2}, {0.2, 0.1}, {0.6, 0.1}, {0.4, 0.4}};
    shape.paths = {{0, 1, 2, 3, 4}, {5, 6, 7}};
    shape.height = dice_.between(0.5, 2);
    return transformed(node_of(shape), translation(dice_.point(1)));
  }

  void choose_changes() {
    constexpr std::array kShares{0.0, 0.004, 0.02, 0.2};
    share_ = kShares[dice_.below(kShares.size())];
    factor_ = dice_.one_in(3) ? extreme_power(dice_) : 1;
    map_share_ = dice_.one_in(2) ? 0.3 : 0;
  }

  double changed(double was, const std::string& key) {
    double v = keeps_scale(key) ? was : was * factor_;
    if (dice_.unit() < share_) v = extreme_number(dice_, v);
    return std::isfinite(v) ? v : 0;
  }

  /// The text with other numbers from the camera on; indices of corners and counts stay.
  std::string with_numbers(const std::string& text) {
    std::string out;
    std::string key;
    const std::size_t begin = text.find("\"camera\"");
    for (std::size_t i = 0; i < text.size();) {
      if (text[i] == '"') {
        const std::size_t end = text.find('"', i + 1) + 1;
        if (text[end] == ':') key = text.substr(i + 1, end - i - 2);
        out += text.substr(i, end - i);
        i = end;
      } else if (i > begin && is_number(text[i])) {
        double v = 0;
        const char* const last = text.data() + text.size();
        const char* const end = std::from_chars(text.data() + i, last, v).ptr;
        const auto length = static_cast<std::size_t>(end - text.data()) - i;
        out += may_change(key) ? written(changed(v, key)) : text.substr(i, length);
        i += length;
      } else {
        out += text[i++];
      }
    }
    return out;
  }

  static bool is_number(char c) {
    return c == '-' || std::isdigit(static_cast<unsigned char>(c)) != 0;
  }
  static bool may_change(const std::string& key) {
    return key != "faces" && key != "paths" && key != "max_depth";
  }
  /// Whether numbers of this key stay as they are where the whole scene is scaled.
  static bool keeps_scale(const std::string& key) {
    constexpr std::array<std::string_view, 16> kPlain{
        "fov",       "up",      "axis",         "pixel_offset", "color",    "background",
        "ambient",   "diffuse", "specular",     "reflect",      "transmit", "ior",
        "shininess", "matrix",  "coefficients", "min_weight"};
    return std::find(kPlain.begin(), kPlain.end(), key) != kPlain.end();
  }

  std::string vector(double x, double y, double z) {
    return "[" + written(x) + "," + written(y) + "," + written(z) + "]";
  }
  std::string step() {
    const double thin = std::pow(10.0, dice_.between(-14, 0));
    switch (dice_.below(5)) {
      case 0: return "{\"scale\":" + vector(thin, 1, 1) + "}";
      case 1: return "{\"scale\":" + vector(1, 1 / thin, 1) + "}";
      case 2: return "{\"scale\":" + written(extreme_power(dice_)) + "}";
      case 3: return "{\"translate\":" + vector(dice_.sign() * extreme_power(dice_), 0, 1) + "}";
      default: {
        const Vec3 axis = dice_.unit_vector();
        return "{\"rotate\":{\"axis\":" + vector(axis.x, axis.y, axis.z) +
               ",\"angle\":" + written(dice_.between(0, 360)) + "}}";
      }
    }
  }

  /// The text with steps put before those of its maps, and maps given to solids without any.
  std::string with_maps(const std::string& text) {
    constexpr std::string_view kMap = "\"transform\": [", kType = "\"type\": ";
    if (map_share_ == 0) return text;
    std::string out;
    const std::size_t solids = text.find("\"shapes\"");
    for (std::size_t i = 0; i < text.size();) {
      const bool is_map = text.compare(i, kMap.size(), kMap) == 0;
      const bool is_type = text.compare(i, kType.size(), kType) == 0;
      if (i < solids || !(is_map || is_type) || dice_.unit() >= map_share_) {
        out += text[i++];
      } else if (is_map) {
        out += std::string(kMap) + step() + "," + step() + ",";
        i += kMap.size();
      } else {
        // A node that has a map becomes one with the key twice, which the reader refuses.
        if (!has_map(text, i)) out += std::string(kMap) + step() + "," + step() + "],";
        out += kType;
        i += kType.size();
      }
    }
    return out;
  }
  /// Whether the node whose type stands at `at` has a map.
  static bool has_map(const std::string& text, std::size_t at) {
    int depth = 0;
    for (std::size_t i = at; i < text.size() && depth >= 0; ++i) {
      if (text[i] == '{' || text[i] == '[') ++depth;
      if (text[i] == '}' || text[i] == ']') --depth;
      if (depth == 0 && text.compare(i, 11, "\"transform\"") == 0) return true;
    }
    return false;
  }

  std::uint64_t seed_;
  Dice dice_;
  /// The share of numbers that are replaced, and of nodes whose maps get more steps.
  double share_ = 0, map_share_ = 0;
  double factor_ = 1;
};

}  // namespace graycube::testing
