// BRL-CAD's solids as nodes of a scene: exact primitives, or a few of them joined.
#pragma once

#include <optional>
#include <string>

#include "formats/brlcad/database.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// rt takes surfaces of one region that are nearer to each other than this, in mm, for one: so a
/// cut flush with a face leaves no skin. Here what is cut off is that much larger.
inline constexpr double kBrlcadSkin = 0.0005;
/// Coordinates further off than this, in mm, mean nothing; their products might overflow.
inline constexpr double kMostBrlcadSize = 1e12;
/// Corners of an arb may lie so far off their face's plane, in parts of the arb's size, or in
/// kBrlcadSkin.
inline constexpr double kBrlcadPlanar = 1e-3;

struct BrlcadNode {
  /// Absent when `problem` says why; rt leaves such solids out, unless `is_error`.
  std::optional<CsgNode> node;
  std::string problem;
  bool is_error = false;
};

/// The solid in world coordinates under `to_world`, every face moved outwards by `grow` mm.
BrlcadNode brlcad_node(const BrlcadSolid& solid, const Affine& to_world, double grow);
/// Of an ars or a bot: a closed mesh, or why there is none.
BrlcadNode brlcad_mesh_node(const BrlcadMesh& mesh, const Affine& to_world, double grow);

}  // namespace graycube
