// The meshes that OpenSCAD builds for extrusions.
#pragma once

#include <optional>
#include <vector>

#include "flat/polygon.hpp"
#include "formats/openscad/language/arguments.hpp"
#include "mesh/close_mesh.hpp"

namespace graycube {

/// A sweep along z from low to high, turned by −twist degrees and scaled at the upper end. 0 slices
/// stand for as many as OpenSCAD takes.
struct LinearSweep {
  double low = 0, high = 0, twist = 0;
  FlatPoint scale{1, 1};
  /// How far it moves sideways for each unit of height; the mesh stands upright all the same.
  FlatPoint lean{};
  int slices = 0;
  ScadFineness fineness;

  bool is_straight() const { return twist == 0 && scale == FlatPoint{1, 1}; }
};

/// A turn about z by `angle` degrees, −360 < angle ≤ 360 and not 0, from `start` on; x is the
/// distance from the axis, negative if `mirrored`.
struct TurnSweep {
  double angle = 360, start = 0;
  bool mirrored = false;
  ScadFineness fineness;
};

/// A mesh for each connected part, holes included; nothing where outlines cross one another.
std::optional<std::vector<PolygonMesh>> swept(const FlatLoops& loops, const LinearSweep& sweep);
std::optional<std::vector<PolygonMesh>> turned_mesh(const FlatLoops& loops, const TurnSweep& sweep);

/// The slices asked for; if none are, those that OpenSCAD 2021.01 takes.
int slices_of(const FlatLoops& loops, const LinearSweep& sweep);
/// The number of facets round the turn.
int steps_of(const FlatLoops& loops, const TurnSweep& sweep);

}  // namespace graycube
