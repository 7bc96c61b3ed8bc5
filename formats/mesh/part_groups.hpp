// Finds the meshes of a file that belong together: those that continue each other at open edges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "formats/mesh/mesh_parts.hpp"

namespace graycube {

/// Groups of the parts' indices, in order. Two parts are in one group where an edge between the
/// same places (within rounding) is used more often one way than the other by both.
std::vector<std::vector<std::uint32_t>> groups_at_open_edges(std::span<const MeshPart> parts);

}  // namespace graycube
