// BRL-CAD's checker on half-spaces. On other solids its squares follow the solid's own u and v,
// which no pattern has.
#pragma once

#include <array>
#include <optional>

#include "formats/brlcad/database/database.hpp"
#include "formats/brlcad/shader_words.hpp"
#include "geometry/affine.hpp"
#include "shading/pattern.hpp"

namespace graycube::brlcad {

struct Checker {
  std::array<Rgb, 2> colors;
  /// How many squares lie along u and v from 0 to 1.
  double scale = 2;
};

/// Nothing when the shader is another one.
std::optional<Checker> checker_of(const ShaderWords& words);

/// The checker on a half-space that `to_world` moves; nothing when the solid is another one, or the
/// scale isn't 2: then the squares don't all have one size.
std::optional<Pattern> checker_pattern(const Checker& checker, const BrlcadSolid& solid,
                                       const Affine& to_world);

}  // namespace graycube::brlcad
