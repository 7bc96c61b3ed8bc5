// linear_extrude() and rotate_extrude(): exact if OpenSCAD's solid is the sweep itself; meshes of
// OpenSCAD's own facets if it isn't (twist, scale), or if facets are asked for.
#pragma once

#include <optional>
#include <vector>

#include "formats/openscad/flat/shape.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// The solid of one of the two modules in its own coordinates; nothing if it is empty, or wrong,
/// which is reported.
std::optional<CsgNode> openscad_sweep(const ScadModule& module, ScadImport& import);
/// The same in OpenSCAD's facets.
std::optional<CsgNode> faceted_sweep(const ScadModule& module, ScadImport& import);

/// The figure × [low, high] along z.
std::optional<CsgNode> extruded(const FlatShape& shape, double low, double high, ScadImport& import,
                                int line);

/// The corners of OpenSCAD's mesh of the solid. False if it is empty, or wrong, which is reported.
bool sweep_corners(const ScadModule& module, ScadImport& import, std::vector<Vec3>& corners);

/// A linear_extrude() without twist: the figure grows evenly by `scale` from one height to the
/// other.
struct PlainSweep {
  FlatShape shape;
  double low = 0, high = 0;
  FlatPoint scale{1, 1};
};
/// False for one with twist; nothing in `sweep` if the solid is empty, or wrong, which is
/// reported.
bool plain_sweep(const ScadModule& module, ScadImport& import, std::optional<PlainSweep>& sweep);

/// Whether what grows or shrinks evenly has an exact form: its figure is convex.
bool is_exact_taper(const PlainSweep& sweep);

/// A rotate_extrude() that is round: a turn by `angle` degrees from `start` on, in which OpenSCAD
/// gives it so many facets.
struct RoundTurn {
  FlatShape shape;
  double start = 0, angle = 360;
  int steps = 0;
};
/// Nothing for any other.
std::optional<RoundTurn> round_turn(const ScadModule& module, ScadImport& import);

/// The hull of disks and points, each with its mirror image, turned about the y axis, which becomes
/// z. Nothing if a disk reaches the axis but isn't centred on it.
std::optional<CsgNode> solid_of_profile(const std::vector<FlatDisk>& profile, ScadImport& import,
                                        int line);

/// A closed mesh as a leaf; nothing when it is empty, or, with a warning, when it isn't closed.
std::optional<CsgNode> mesh_leaf(const PolygonMesh& mesh, const ScadModule& module,
                                 OpenscadReport& report);

}  // namespace graycube
