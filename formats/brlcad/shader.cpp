#include "formats/brlcad/shader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "formats/brlcad/database/database.hpp"
#include "formats/brlcad/shader_pattern.hpp"
#include "formats/brlcad/shader_words.hpp"

namespace graycube {
namespace {

using brlcad::number_behind;
using brlcad::pattern_of;
using brlcad::pattern_on_solids_of;
using brlcad::shaders_of;
using brlcad::ShaderWords;
using brlcad::vector_behind;

/// The values that rt's plastic, glass and mirror have unless parameters set others.
struct Look {
  double shine, specular, diffuse, transmit, reflect, index;
};
constexpr Look kPlastic{10, 0.7, 0.3, 0, 0, 1};
constexpr Look kGlass{4, 0.7, 0.3, 0.8, 0.1, 1.65};
constexpr Look kMirror{4, 0.6, 0.4, 0, 0.75, 1.65};

bool is_known(std::string_view name) {
  constexpr std::string_view kKnown[] = {"plastic", "phong", "default", "glass", "mirror", "light"};
  return std::find(std::begin(kKnown), std::end(kKnown), name) != std::end(kKnown);
}

bool is_one_of(std::string_view key, std::span<const std::string_view> names) {
  return std::find(names.begin(), names.end(), key) != names.end();
}

/// Reads the parameters of plastic, glass and mirror into a look.
void read_look(const ShaderWords& words, Look& look) {
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const std::string& key = words[i];
    const auto value = number_behind(words, i);
    if (!value || *value < 0) continue;
    const double fraction = std::min(*value, 1.0);
    // rt reads the shine as an integer.
    if (key == "sh" || key == "shine") look.shine = std::trunc(*value);
    if (key == "sp" || key == "specular") look.specular = *value;
    if (key == "di" || key == "diffuse") look.diffuse = *value;
    if (key == "tr" || key == "transmit") look.transmit = fraction;
    if (key == "re" || key == "reflect") look.reflect = fraction;
    if ((key == "ri" || key == "r" || key == "refrac") && *value > 0) look.index = *value;
  }
}

/// A colour that is the same in any light.
void make_unlit(Material& m) {
  m.ambient = 1;
  m.diffuse = 0;
}

/// The colour of the shader `flat`: its own, or the region's.
Rgb flat_color(const ShaderWords& words, Rgb color) {
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const auto rgb = vector_behind(words, i);
    const auto grey = number_behind(words, i);
    if (rgb && (words[i] == "color" || words[i] == "rgb")) color = brlcad::unit_color(*rgb);
    if (grey && words[i] == "bright") color = brlcad::unit_color({*grey, *grey, *grey});
  }
  return color;
}

BrlcadLamp read_lamp(const ShaderWords& words) {
  constexpr std::string_view kIntensity[] = {"b", "bright", "inten"}, kFraction[] = {"f", "fract"},
                             kShadows[] = {"s", "shadows"}, kInfinite[] = {"i", "infinite"},
                             kVisible[] = {"v", "visible"}, kInvisible[] = {"invisible"},
                             kAngle[] = {"a", "angle"},
                             kTarget[] = {"t", "target", "aim", "d", "dir"};
  BrlcadLamp lamp;
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const std::string& key = words[i];
    const auto target = is_one_of(key, kTarget) ? vector_behind(words, i) : std::nullopt;
    if (target) lamp.target = *target;
    lamp.has_target = lamp.has_target || target;
    const auto value = number_behind(words, i);
    if (!value) continue;
    if (is_one_of(key, kIntensity)) lamp.intensity = *value > 0 ? *value : 1;
    if (is_one_of(key, kFraction)) lamp.fraction = *value;
    if (is_one_of(key, kShadows)) lamp.has_shadows = *value != 0;
    if (is_one_of(key, kInfinite)) lamp.is_infinite = *value != 0;
    if (is_one_of(key, kVisible)) lamp.is_invisible = *value == 0;
    if (is_one_of(key, kInvisible)) lamp.is_invisible = *value != 0;
    // The cosine of the angle is what rt goes by.
    if (is_one_of(key, kAngle)) lamp.angle_degrees = std::min(std::fabs(*value), 180.0);
  }
  return lamp;
}

/// The shaders of a region that count.
struct Effective {
  /// The last that lights or shines, and the last that gives colours by place.
  ShaderWords lit;
  std::optional<Pattern> pattern;
  /// The pattern is one of u and v.
  bool is_on_solids = false;
  /// Whether the colours are laid over what is lit: then they are the same in any light.
  bool is_pattern_last = false;
};

Effective effective_shaders(const std::string& shader, const std::string& region,
                            BrlcadReport& report) {
  const std::vector<ShaderWords> shaders = shaders_of(shader);
  Effective found;
  for (const ShaderWords& words : shaders) {
    if (is_known(words.front()) || shaders.size() == 1) {
      found.lit = words;
      found.is_pattern_last = false;
    }
    const auto in_space = pattern_of(words), on_solids = pattern_on_solids_of(words);
    if (in_space || on_solids) {
      found.pattern = in_space ? in_space : on_solids;
      found.is_on_solids = on_solids.has_value();
      found.is_pattern_last = true;
    } else if (!is_known(words.front()) && shaders.size() > 1) {
      report.changed("regions", "the shader '" + words.front() + "' of a stack isn't drawn",
                     region);
    }
  }
  return found;
}

BrlcadSurface lamp_surface(const ShaderWords& words, const Rgb& color) {
  BrlcadSurface out;
  out.material.color = color;
  out.is_light = true;
  out.lamp = read_lamp(words);
  // Light on its way from any lamp passes: rt takes a lamp that is met for the one aimed at.
  out.material.model = ShadingModel::kRtLamp;
  out.material.diffuse = 0;
  out.material.transmit = 1;
  return out;
}

void set_look(const Look& look, Material& m) {
  m.model = ShadingModel::kRt;
  m.ambient = kBrlcadAmbient;
  m.diffuse = look.diffuse;
  m.specular = look.specular;
  m.shininess = look.shine;
  m.transmit = look.transmit;
  m.reflect = look.reflect;
  m.ior = look.index;
}

}  // namespace

BrlcadSurface brlcad_surface(const std::string& shader, const std::array<int, 3>& rgb,
                             const std::string& region, BrlcadReport& report) {
  const Effective shaders = effective_shaders(shader, region, report);
  const ShaderWords& words = shaders.lit;
  const std::string name = words.empty() ? "plastic" : words.front();
  const Rgb color{rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0};
  if (name == "light") return lamp_surface(words, color);
  BrlcadSurface out;
  out.is_environment = name == "envmap";
  if (out.is_environment) return out;
  Material& m = out.material;
  m.color = color;
  if (shaders.pattern && shaders.is_on_solids) {
    out.on_solids = shaders.pattern;
    m.color = color_at(*shaders.pattern, shaders.pattern->colors[0], {0, 0, 0});
  } else if (shaders.pattern) {
    m.pattern = *shaders.pattern;
  }
  if (shaders.is_pattern_last) {
    make_unlit(m);
    return out;
  }
  if (name == "flat") m.color = flat_color(words, color);
  if (name == "flat") {
    make_unlit(m);
    return out;
  }
  Look look = name == "glass" ? kGlass : name == "mirror" ? kMirror : kPlastic;
  if (is_known(name)) {
    read_look(words, look);
  } else {
    report.changed("regions", "the shader '" + name + "' is taken for plastic", region);
  }
  set_look(look, m);
  return out;
}

}  // namespace graycube
