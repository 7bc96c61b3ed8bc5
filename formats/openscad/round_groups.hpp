// The round surfaces of OpenSCAD's modules that can be of facets, in groups: those of a group are
// of facets together, because they are tangent to the same planes.
#pragma once

#include <cstdint>
#include <vector>

#include "formats/openscad/flat/shape.hpp"
#include "formats/openscad/hulls/round_ring.hpp"
#include "formats/openscad/language/limits.hpp"
#include "formats/openscad/language/matrix.hpp"

namespace graycube {

using RoundGroup = std::vector<RoundRing>;

/// The share of coordinates by which two matrices of so many digits may place points differently.
constexpr double placing_share(std::uint32_t digits) {
  return digits == kOpenscadDigits ? 1e-5 : 1e-9;
}

/// Levels of modules that are looked into.
inline constexpr int kMostRoundLevels = 256;

/// Whether the module only gathers, places or cuts the solids in it.
bool is_around_solids(const std::string& name);

/// Calls visit(module, to_world) for each solid in a module, and for each flat shape that nothing
/// extrudes. A hull() or a minkowski() is one solid. Matrices have `digits` digits.
template <typename Visit>
void for_each_solid(const ScadModule& module, const Affine& to_world, std::uint32_t digits,
                    const Visit& visit, int levels = kMostRoundLevels) {
  if (module.left_out || levels == 0) return;
  const bool is_matrix = module.name == "multmatrix";
  if (!is_matrix && (module.dimension == 2 || !is_around_solids(module.name)))
    return visit(module, to_world);
  Affine inner = to_world;
  if (is_matrix) {
    OpenscadReport unread;
    const auto own = openscad_matrix(module, digits, unread);
    if (!own) return;
    inner = compose(to_world, *own);
    if (!inner.inverse()) return;
  }
  for (const ScadModule& child : module.children)
    for_each_solid(child, inner, digits, visit, levels - 1);
}

/// Those of a solid that for_each_solid() visits: a sphere(), a straight cylinder(), what is
/// extruded or turned from circles, all that a hull() is of. Of a minkowski() it is one group: what
/// is round in one operand at each corner of the others, and the sums of what is round in several,
/// where a ring tells these; none where there are too many.
std::vector<RoundGroup> round_groups(const ScadModule& module, const Affine& to_world,
                                     ScadImport& import);
/// Those of an upright extrusion of a figure.
std::vector<RoundGroup> round_groups(const FlatShape& figure, const Affine& to_world);

}  // namespace graycube
