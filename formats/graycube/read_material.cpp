#include "formats/graycube/read_material.hpp"

#include <array>
#include <span>
#include <string>

#include "formats/graycube/read_pattern.hpp"
#include "formats/graycube/scene_words.hpp"
#include "spelling.hpp"

namespace graycube {
namespace {

enum Key : std::size_t {
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
  kRoughness,
  kAbsorption,
  kAttenuation,
  kTransmitShininess,
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
                                             {"pattern"},
                                             {"roughness"},
                                             {"absorption"},
                                             {"attenuation"},
                                             {"transmit_shininess"}}};
using Members = std::array<JsonIndex, kKeys>;

constexpr NumberRule kIndex{
    .what = "a number from 0.001 to 1000", .min = kLeastIndex, .max = kMostIndex};
constexpr NumberRule kAbsorbing{.what = "a number from 0 to 1000", .min = 0, .max = kMostIndex};
constexpr NumberRule kRoughnesses{
    .what = "a number from 0.001 to 1", .min = kLeastRoughness, .max = kMostRoughness};

bool has_key(ShadingModel model, Key key) {
  switch (key) {
    case kShininess: return model != ShadingModel::kTorranceSparrow;
    case kRoughness: return model == ShadingModel::kTorranceSparrow;
    case kAbsorption:
      return model == ShadingModel::kTorranceSparrow || model == ShadingModel::kHallGreenberg;
    case kAttenuation:
    case kTransmitShininess: return model == ShadingModel::kHallGreenberg;
    default: return true;
  }
}

/// Reports keys that belong to other models, with those models, or the key that is meant.
void check_keys(JsonAccess& json, const Members& member, ShadingModel model) {
  for (std::size_t k = 0; k < kKeys; ++k) {
    const Key key = static_cast<Key>(k);
    if (member[key] == 0 || has_key(model, key)) continue;
    std::string text = "the model " + quoted(word_of(kShadingModelWords, model)) + " has no key " +
                       quoted(kRules[key].name);
    if (key == kShininess || key == kRoughness) {
      text += "; did you mean " + quoted(kRules[key == kShininess ? kRoughness : kShininess].name) +
              "?";
    } else {
      std::string before = "; it belongs to ";
      for (const auto& word : kShadingModelWords) {
        if (!has_key(word.value, key)) continue;
        text += before + quoted(word.name);
        before = " and ";
      }
    }
    json.errors.add(member[key], text);
  }
}

/// Reads one number for all colours, or a list of red's, green's and blue's.
void read_by_colour(JsonAccess& json, JsonIndex at, Rgb& out, const NumberRule& rule) {
  if (at == 0) return;
  if (json.tree.kind(at) == JsonKind::kNumber) {
    double all = 0;
    if (json.read(at, all, rule)) out = {all, all, all};
    return;
  }
  if (json.tree.kind(at) != JsonKind::kArray || json.tree.size(at) != 3) {
    json.wrong(at, std::string(rule.what) + ", or three of them for red, green and blue");
    return;
  }
  JsonIndex m = json.tree.first_child(at);
  for (double* v : {&out.r, &out.g, &out.b}) {
    json.read(m, *v, rule);
    m = json.tree.next(m);
  }
}

/// What lets light through has one index, or its rays would part, and no metal does.
void check_transparency(JsonAccess& json, const Members& member, const Material& m) {
  if (!(m.transmit > 0)) return;
  const Rgb& n = m.optics.index;
  if (n != Rgb{n.r, n.r, n.r})
    json.errors.add(member[kIor], "light goes through (transmit is not 0): expected one number");
  if (max_component(m.optics.absorption) > 0)
    json.errors.add(member[kAbsorption],
                    "a metal lets no light through: expected 0, or transmit to be 0; to dim light "
                    "on its way inside use " +
                        quoted(kRules[kAttenuation].name));
}

/// The parts of a material that Fresnel's equations need.
void read_optics(JsonAccess& json, const Members& member, Material& out) {
  Optics& o = out.optics;
  read_by_colour(json, member[kIor], o.index, kIndex);
  out.ior = o.index.r;
  read_by_colour(json, member[kAbsorption], o.absorption, kAbsorbing);
  if (out.model == ShadingModel::kTorranceSparrow) {
    json.read_optional(member[kRoughness], o.roughness, kRoughnesses);
  } else {
    read_by_colour(json, member[kAttenuation], o.attenuation, kNotNegative);
    o.transmit_shininess = out.shininess;
    json.read_optional(member[kTransmitShininess], o.transmit_shininess, kNotNegative);
  }
  check_transparency(json, member, out);
}

}  // namespace

void read_material(JsonAccess& json, JsonIndex at, Material& out) {
  Members member{};
  json.members(at, "a material", kRules, member);
  const bool is_model_known = json.read_word(member[kModel], out.model, kShadingModelWords);
  if (is_model_known) check_keys(json, member, out.model);
  const NumberRule& share = has_fresnel(out) ? kFraction : kNotNegative;
  json.read_optional(member[kColor], out.color);
  json.read_optional(member[kAmbient], out.ambient, kNotNegative);
  json.read_optional(member[kDiffuse], out.diffuse, share);
  json.read_optional(member[kSpecular], out.specular, share);
  if (has_key(out.model, kShininess))
    json.read_optional(member[kShininess], out.shininess, kNotNegative);
  json.read_optional(member[kReflect], out.reflect, share);
  json.read_optional(member[kTransmit], out.transmit, kFraction);
  if (has_fresnel(out))
    read_optics(json, member, out);
  else if (is_model_known)
    json.read_optional(member[kIor], out.ior, kPositive);
  if (member[kPattern] != 0) read_pattern(json, member[kPattern], out.pattern);
}

}  // namespace graycube
