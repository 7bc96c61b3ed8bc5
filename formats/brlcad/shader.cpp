#include "formats/brlcad/shader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "formats/brlcad/database/database.hpp"
#include "formats/brlcad/database/words.hpp"

namespace graycube {
namespace {

constexpr std::size_t kMostWords = 256;

/// The values that rt's plastic, glass and mirror have unless parameters set others.
struct Look {
  double shine, specular, diffuse, transmit, reflect, index;
};
constexpr Look kPlastic{10, 0.7, 0.3, 0, 0, 1};
constexpr Look kGlass{4, 0.7, 0.3, 0.8, 0.1, 1.65};
constexpr Look kMirror{4, 0.6, 0.4, 0, 0.75, 1.65};

/// A shader's name, and the words and values of its parameters in turn.
using Words = std::vector<std::string>;

bool is_known(std::string_view name) {
  constexpr std::string_view kKnown[] = {"plastic", "phong", "default", "glass", "mirror", "light"};
  return std::find(std::begin(kKnown), std::end(kKnown), name) != std::end(kKnown);
}

/// Cuts a shader up, whichever way its parameters are written.
Words words_of(std::string text) {
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return std::string_view("={},;\"\n").find(c) != std::string_view::npos; }, ' ');
  Words words;
  for (const std::string_view w : blank_separated(text, kMostWords)) words.emplace_back(w);
  return words;
}

/// The shaders of a stack, as `{plastic {…}} {bump {…}}`, or as `plastic …; bump …`.
std::vector<Words> members_of_stack(std::string_view text) {
  std::vector<Words> members;
  if (text.find(';') != std::string_view::npos) {
    while (!text.empty() && members.size() < kMostWords) {
      const std::size_t end = std::min(text.find(';'), text.size());
      members.push_back(words_of(std::string(text.substr(0, end))));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    return members;
  }
  TclWords words(text);
  for (std::string word; members.size() < kMostWords && words.next(word);) {
    members.push_back(words_of(word));
    // A list of the members may itself be in braces.
    if (word.find('{') == 0) return members_of_stack(word);
  }
  return members;
}

/// The words of the shader that counts.
Words effective_words(const std::string& shader) {
  const std::size_t start = std::min(shader.find_first_not_of(" \t{"), shader.size());
  const std::string_view text = std::string_view(shader).substr(start);
  constexpr std::string_view kStack = "stack";
  if (!text.starts_with(kStack)) return words_of(shader);
  Words found = words_of(shader);
  for (Words& member : members_of_stack(text.substr(kStack.size()))) {
    if (!member.empty() && is_known(member.front())) found = std::move(member);
  }
  return found;
}

std::optional<double> value_behind(const Words& words, std::size_t i) {
  return i + 1 < words.size() ? parse_brlcad_number(words[i + 1]) : std::nullopt;
}

bool is_one_of(std::string_view key, std::span<const std::string_view> names) {
  return std::find(names.begin(), names.end(), key) != names.end();
}

/// Reads the parameters of plastic, glass and mirror into a look.
void read_look(const Words& words, Look& look) {
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const std::string& key = words[i];
    const auto value = value_behind(words, i);
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

/// A checker whose two colours are one is that colour, whatever the light: rt doesn't light
/// checkers.
bool is_one_coloured(const Words& words, Material& m) {
  const auto color_behind = [&](std::string_view key) {
    const auto at = std::find(words.begin(), words.end(), key);
    const bool is_there = std::distance(at, words.end()) > 1;
    return is_there ? parse_brlcad_rgb(*std::next(at)) : std::nullopt;
  };
  const auto a = color_behind("a"), b = color_behind("b");
  if (!a || !b || *a != *b) return false;
  m.color = {(*a)[0] / 255.0, (*a)[1] / 255.0, (*a)[2] / 255.0};
  m.ambient = 1;
  m.diffuse = 0;
  return true;
}

/// Reads the three numbers behind a word.
void read_target(const Words& words, std::size_t i, BrlcadLamp& lamp) {
  const auto x = value_behind(words, i), y = value_behind(words, i + 1),
             z = value_behind(words, i + 2);
  if (!x || !y || !z) return;
  lamp.has_target = true;
  lamp.target = {*x, *y, *z};
}

BrlcadLamp read_lamp(const Words& words) {
  constexpr std::string_view kIntensity[] = {"b", "bright", "inten"}, kFraction[] = {"f", "fract"},
                             kShadows[] = {"s", "shadows"}, kInfinite[] = {"i", "infinite"},
                             kVisible[] = {"v", "visible"}, kInvisible[] = {"invisible"},
                             kAngle[] = {"a", "angle"},
                             kTarget[] = {"t", "target", "aim", "d", "dir"};
  BrlcadLamp lamp;
  for (std::size_t i = 1; i + 1 < words.size(); ++i) {
    const auto value = value_behind(words, i);
    if (!value) continue;
    const std::string& key = words[i];
    if (is_one_of(key, kIntensity)) lamp.intensity = *value > 0 ? *value : 1;
    if (is_one_of(key, kFraction)) lamp.fraction = *value;
    if (is_one_of(key, kShadows)) lamp.has_shadows = *value != 0;
    if (is_one_of(key, kInfinite)) lamp.is_infinite = *value != 0;
    if (is_one_of(key, kVisible)) lamp.is_invisible = *value == 0;
    if (is_one_of(key, kInvisible)) lamp.is_invisible = *value != 0;
    // The cosine of the angle is what rt goes by.
    if (is_one_of(key, kAngle)) lamp.angle_degrees = std::min(std::fabs(*value), 180.0);
    if (is_one_of(key, kTarget)) read_target(words, i, lamp);
  }
  return lamp;
}

}  // namespace

BrlcadSurface brlcad_surface(const std::string& shader, const std::array<int, 3>& rgb,
                             const std::string& region, BrlcadReport& report) {
  const Words words = effective_words(shader);
  const std::string name = words.empty() ? "plastic" : words.front();
  BrlcadSurface out;
  Material& m = out.material;
  m.color = {rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0};
  out.is_light = name == "light";
  if (out.is_light) {
    out.lamp = read_lamp(words);
    // Light on its way from any lamp passes: rt takes a lamp that is met for the one aimed at.
    m.model = ShadingModel::kRtLamp;
    m.diffuse = 0;
    m.transmit = 1;
    return out;
  }
  if (name == "checker" && is_one_coloured(words, m)) return out;
  Look look = name == "glass" ? kGlass : name == "mirror" ? kMirror : kPlastic;
  if (is_known(name)) {
    read_look(words, look);
  } else {
    report.changed("regions", "the shader '" + name + "' is taken for plastic", region);
  }
  m.model = ShadingModel::kRt;
  m.ambient = kBrlcadAmbient;
  m.diffuse = look.diffuse;
  m.specular = look.specular;
  m.shininess = look.shine;
  m.transmit = look.transmit;
  m.reflect = look.reflect;
  m.ior = look.index;
  return out;
}

}  // namespace graycube
