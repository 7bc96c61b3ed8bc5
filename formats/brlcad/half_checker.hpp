// BRL-CAD's checker on half-spaces, as squares in space: they all have one size there.
#pragma once

#include <optional>

#include "formats/brlcad/database/database.hpp"
#include "geometry/affine.hpp"
#include "shading/pattern.hpp"

namespace graycube::brlcad {

/// A unit vector across the normal: the product of the axis that is least along it with it. rt
/// counts u along it on half-spaces.
Vec3 across(const Vec3& normal);

/// The checker in space that is the same as `on_surface`, a pattern of u and v, on a half-space
/// that `to_world` moves; nothing for other solids and patterns, and where a checker's scale isn't
/// 2: then its squares differ in size.
std::optional<Pattern> half_space_checker(const Pattern& on_surface, const BrlcadSolid& solid,
                                          const Affine& to_world);

}  // namespace graycube::brlcad
