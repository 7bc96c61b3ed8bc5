// The solids of a .csg file in world coordinates. Transforms are moved down to the leaves, unions
// and groups dissolve in the operation around them, empty operands are dropped as in OpenSCAD.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/openscad/language/options.hpp"
#include "formats/openscad/language/parser.hpp"
#include "formats/view/framing.hpp"

namespace graycube {

/// A solid in world coordinates, one operand of the operation around it.
struct Part {
  CsgNode node;
  Reach reach;
  std::uint32_t levels = 1;
  int line = 0;
  std::string module;
};

/// The result of openscad_parts: the file is the union of the parts. Every leaf has a material.
/// Rotations were recovered from matrices of `digits` digits.
struct OpenscadParts {
  std::vector<Part> parts;
  std::vector<NamedMaterial> materials;
};
OpenscadParts openscad_parts(const std::vector<ScadModule>& modules, const OpenscadOptions& options,
                             std::uint32_t digits, OpenscadReport& report);

Reach reach_of(const std::vector<Part>& parts);
/// The union of at least one part, as one part.
Part united(std::vector<Part> parts);

}  // namespace graycube
