// Where u and v lie on BRL-CAD's solids.
#pragma once

#include <optional>

#include "formats/brlcad/database/database.hpp"
#include "shading/pattern.hpp"

namespace graycube::brlcad {

/// Whether rt knows no u and v on solids of this kind: it takes both for 0 all over them.
bool has_no_chart(BrlcadKind kind);

/// The pattern of u and v, `on_surface`, laid on a solid in world coordinates under `to_world`,
/// whose ends lie `grow` mm further out; nothing when the solid has no size to measure u and v by.
/// The facts are those of librt's primitives (rt_*_prep and rt_*_uv).
std::optional<Pattern> laid_on(const Pattern& on_surface, const BrlcadSolid& solid,
                               const Affine& to_world, double grow);

}  // namespace graycube::brlcad
