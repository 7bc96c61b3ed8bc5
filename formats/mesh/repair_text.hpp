// Says what was repaired.
#pragma once

#include <string>
#include <vector>

#include "mesh/repair_mesh.hpp"

namespace graycube {

/// Adds what was done to one mesh to what was done to those before.
void add_repairs(MeshRepairs& sum, const MeshRepairs& more);

/// A line for each kind of repair, none if nothing was done.
std::vector<std::string> texts_of(const MeshRepairs& repairs);

}  // namespace graycube
