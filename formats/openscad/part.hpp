// One solid of a .csg file, on its way to becoming an object or an operand.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "formats/view/framing.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// A solid, one operand of the operation around it: in world coordinates, or under
/// OpenscadParts::around_all.
struct Part {
  CsgNode node;
  Reach reach;
  std::uint32_t levels = 1;
  int line = 0;
  std::string module;
};

Reach reach_of(const std::vector<Part>& parts);
/// The union of at least one part, as one part.
Part united(std::vector<Part> parts);

/// The levels of operations and their leaves.
std::uint32_t levels_of(const CsgNode& node);

/// The leaf or operation under a map; spheres under rotations stay spheres.
CsgNode placed(CsgNode node, const Affine& map);

}  // namespace graycube
