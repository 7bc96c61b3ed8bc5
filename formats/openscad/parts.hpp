// The solids of a .csg file in world coordinates. Transforms are moved down to the leaves, unions
// and groups dissolve in the operation around them, empty operands are dropped as in OpenSCAD.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/openscad/language/delegate.hpp"
#include "formats/openscad/language/options.hpp"
#include "formats/openscad/language/parser.hpp"
#include "formats/openscad/part.hpp"

namespace graycube {

/// The result of openscad_parts: the file is the union of the parts. Every leaf has a material.
/// Rotations were recovered from matrices of `digits` digits.
struct OpenscadParts {
  std::vector<Part> parts;
  std::vector<NamedMaterial> materials;
  /// The map of the matrices that stand around all parts, where it is kept apart: it counts for no
  /// tolerance, since its rounded numbers move all parts alike. Reaches are in the world.
  std::optional<Affine> around_all;
};
/// Parts that `delegate` hasn't asked for yet are missing, untold. `keeps_apart`: matrices that
/// stand around all parts are not moved down to the leaves.
OpenscadParts openscad_parts(const std::vector<ScadModule>& modules, const OpenscadOptions& options,
                             std::uint32_t digits, bool keeps_apart, OpenscadDelegate& delegate,
                             OpenscadReport& report);

}  // namespace graycube
