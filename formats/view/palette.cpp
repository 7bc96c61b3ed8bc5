#include "formats/view/palette.hpp"

#include <string>
#include <utility>

#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

/// The yellow and the green of OpenSCAD's preview, sRGB.
constexpr std::array<double, 3> kDefaultColor{249 / 255.0, 215 / 255.0, 44 / 255.0};
constexpr std::array<double, 3> kCutColor{157 / 255.0, 203 / 255.0, 81 / 255.0};
constexpr double kAmbient = 0.2;
constexpr double kDiffuse = 0.8;
constexpr double kSpecular = 0.15;
constexpr double kShininess = 30;

double linear_from_srgb(double v) {
  return v <= 0.04045 ? v / 12.92 : portable_pow((v + 0.055) / 1.055, 2.4);
}

/// The colour with all of its components.
ScadColor filled(ScadColor color, ScadFace face) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(color.rgba[i] >= 0))
      color.rgba[i] = face == ScadFace::kCut ? kCutColor[i] : kDefaultColor[i];
  }
  return color;
}

Material material_of(const ScadColor& color) {
  const auto component = [&](std::size_t i) { return linear_from_srgb(color.rgba[i]); };
  Material material;
  material.color = {component(0), component(1), component(2)};
  material.ambient = kAmbient;
  material.diffuse = kDiffuse;
  material.specular = kSpecular;
  material.shininess = kShininess;
  material.transmit = color.rgba[3] >= 0 ? 1 - color.rgba[3] : 0;
  return material;
}

}  // namespace

MaterialIndex Palette::index_of(const ScadColor& color, ScadFace face) {
  const auto next = static_cast<MaterialIndex>(materials_.size());
  const bool is_open = !(color.rgba[0] >= 0 && color.rgba[1] >= 0 && color.rgba[2] >= 0);
  const std::pair key{color.rgba, is_open ? face : ScadFace::kOuter};
  const auto [place, is_new] = index_.try_emplace(key, next);
  if (is_new) {
    const bool is_plain = color.rgba == ScadColor{}.rgba;
    std::string name = !is_plain                  ? "color " + std::to_string(++color_count_)
                       : face == ScadFace::kOuter ? "default"
                                                  : "cut";
    materials_.push_back({std::move(name), material_of(filled(color, face))});
  }
  return place->second;
}

}  // namespace graycube
