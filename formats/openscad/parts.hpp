// The solids of a .csg file in world coordinates: transforms gone down to the leaves, unions and
// groups dissolved in what is around them, empty operands fallen away as in OpenSCAD.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "formats/openscad/language/options.hpp"
#include "formats/openscad/language/parser.hpp"
#include "formats/view/framing.hpp"

namespace graycube {

/// A solid in world coordinates, one operand of whatever is around it.
struct Part {
  CsgNode node;
  Reach reach;
  std::uint32_t levels = 1;
  int line = 0;
  std::string module;
};

/// What `openscad_parts` finds: the file is the union of the parts. Every leaf has a material.
/// Rotations are those of matrices of so many digits.
struct OpenscadParts {
  std::vector<Part> parts;
  std::vector<NamedMaterial> materials;
};
OpenscadParts openscad_parts(const std::vector<ScadModule>& modules, const OpenscadOptions& options,
                             std::uint32_t digits, OpenscadReport& report);

Reach reach_of(const std::vector<Part>& parts);
/// The union of at least one part, as one.
Part united(std::vector<Part> parts);

}  // namespace graycube
