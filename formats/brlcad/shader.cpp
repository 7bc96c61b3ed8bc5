#include "formats/brlcad/shader.hpp"

#include <algorithm>

#include "formats/brlcad/database/words.hpp"

namespace graycube {
namespace {

/// rt's ambient light, which a surface reflects as it does diffuse light.
constexpr double kAmbient = 0.4;
constexpr std::size_t kMostWords = 256;

/// The values that rt's plastic, glass and mirror have unless parameters set others.
struct Look {
  double shine, specular, diffuse, transmit, reflect, index;
};
constexpr Look kPlastic{10, 0.7, 0.3, 0, 0, 1};
constexpr Look kGlass{4, 0.7, 0.3, 0.8, 0.1, 1.65};
constexpr Look kMirror{4, 0.6, 0.4, 0, 0.75, 1.65};

/// The parameters behind the name: words and values in turn, whichever way they are written.
std::vector<std::string> parameters_of(std::string text) {
  std::replace(text.begin(), text.end(), '=', ' ');
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '{' || c == '}' || c == '\n'; }, ' ');
  std::vector<std::string> words;
  for (const std::string_view w : blank_separated(text, kMostWords)) words.emplace_back(w);
  return words;
}

}  // namespace

BrlcadSurface brlcad_surface(const std::string& shader, const std::array<int, 3>& rgb,
                             BrlcadReport& report) {
  const auto words = parameters_of(shader);
  const std::string name = words.empty() ? "plastic" : words.front();
  BrlcadSurface out;
  Look look = name == "glass" ? kGlass : name == "mirror" ? kMirror : kPlastic;
  out.is_light = name == "light";
  const bool is_known = name == "plastic" || name == "glass" || name == "mirror" || out.is_light;
  if (!is_known) {
    report.warning_once("shader " + name, "", "the shader '" + name + "' is taken for plastic");
  }
  for (std::size_t i = 1; is_known && i + 1 < words.size(); i += 2) {
    const std::string& key = words[i];
    const auto value = parse_brlcad_number(words[i + 1]);
    if (!value || *value < 0) continue;
    const double fraction = std::min(*value, 1.0);
    if (key == "sh" || key == "shine") look.shine = *value;
    if (key == "sp" || key == "specular") look.specular = *value;
    if (key == "di" || key == "diffuse") look.diffuse = *value;
    if (key == "tr" || key == "transmit") look.transmit = fraction;
    if (key == "re" || key == "reflect") look.reflect = fraction;
    if ((key == "ri" || key == "r" || key == "refrac") && *value > 0) look.index = *value;
    if (key == "f" || key == "fract" || key == "b" || key == "bright") out.brightness = fraction;
  }
  Material& m = out.material;
  m.color = {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0};
  m.ambient = out.is_light ? 1 : kAmbient * look.diffuse;
  m.diffuse = out.is_light ? 0 : look.diffuse;
  m.specular = out.is_light ? 0 : look.specular;
  m.shininess = look.shine;
  m.transmit = out.is_light ? 0 : look.transmit;
  m.reflect = out.is_light ? 0 : look.reflect;
  m.ior = look.index;
  return out;
}

}  // namespace graycube
