#include "formats/graycube/read_material.hpp"

#include <array>

#include "formats/graycube/read_pattern.hpp"
#include "formats/graycube/scene_words.hpp"

namespace graycube {

void read_material(JsonAccess& json, JsonIndex at, Material& out) {
  enum : std::size_t {
    kColor,
    kAmbient,
    kDiffuse,
    kSpecular,
    kShininess,
    kReflect,
    kTransmit,
    kIor,
    kModel,
    kPattern,
    kKeys
  };
  constexpr std::array<KeyRule, kKeys> kRules{{{"color"},
                                               {"ambient"},
                                               {"diffuse"},
                                               {"specular"},
                                               {"shininess"},
                                               {"reflect"},
                                               {"transmit"},
                                               {"ior"},
                                               {"model"},
                                               {"pattern"}}};
  std::array<JsonIndex, kKeys> member{};
  json.members(at, "a material", kRules, member);
  json.read_optional(member[kColor], out.color);
  json.read_optional(member[kAmbient], out.ambient, kNotNegative);
  json.read_optional(member[kDiffuse], out.diffuse, kNotNegative);
  json.read_optional(member[kSpecular], out.specular, kNotNegative);
  json.read_optional(member[kShininess], out.shininess, kNotNegative);
  json.read_optional(member[kReflect], out.reflect, kNotNegative);
  json.read_optional(member[kTransmit], out.transmit, kFraction);
  json.read_optional(member[kIor], out.ior, kPositive);
  json.read_word(member[kModel], out.model, kShadingModelWords);
  if (member[kPattern] != 0) read_pattern(json, member[kPattern], out.pattern);
}

}  // namespace graycube
