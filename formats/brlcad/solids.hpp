// BRL-CAD's solids as nodes of a scene: exact primitives, or a few of them joined.
#pragma once

#include <optional>
#include <string>

#include "formats/brlcad/database/database.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// rt takes surfaces of one region that are nearer to each other than this, in mm, for one: so a
/// cut flush with a face leaves no skin. Here solids that are cut off are that much larger.
inline constexpr double kBrlcadSkin = 0.0005;
/// Coordinates further off than this, in mm, are meaningless; their products might overflow.
inline constexpr double kMostBrlcadSize = 1e12;
/// Corners of an arb that are farther off their face's plane than this part of the arb's size, and
/// than kBrlcadSkin, are told of.
inline constexpr double kBrlcadPlanar = 1e-3;

struct BrlcadNode {
  /// Absent when `problem` says why. The solid alone is left out, as by rt; or, where it
  /// `is_unsupported` here but not by rt, the whole region.
  std::optional<CsgNode> node;
  std::string problem;
  bool is_unsupported = false;
  /// What is drawn otherwise than it is written; empty if nothing is.
  std::string change;
  /// More about `problem`, which holds for this solid only.
  std::string detail;
};

/// The solid in world coordinates under `to_world`, every face moved outwards by `grow` mm.
BrlcadNode brlcad_node(const BrlcadSolid& solid, const Affine& to_world, double grow);
/// The closed mesh of an ars or a bot, with `grow` as above; or why there is none.
BrlcadNode brlcad_mesh_node(const BrlcadMesh& mesh, const Affine& to_world, double grow);

}  // namespace graycube
