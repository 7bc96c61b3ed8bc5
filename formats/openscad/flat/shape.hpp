// The two-dimensional part of a .csg file: squares, circles, polygons and operations on them as
// figures, and all other modules as polygons.
#pragma once

#include <optional>
#include <vector>

#include "flat/polygon.hpp"
#include "flat/rounded_polygon.hpp"
#include "flat/rounds.hpp"
#include "formats/openscad/program/import.hpp"

namespace graycube {

/// A figure that isn't empty. Circles and their images stay exact; operations remain only above
/// them.
struct FlatShape {
  enum class Kind : std::uint8_t { kPolygon, kDisk, kUnion, kIntersection, kDifference };
  Kind kind = Kind::kPolygon;
  /// The outlines of a polygon.
  FlatLoops loops;
  /// A disk is the image of the unit disk under this map; OpenSCAD gives it `sides` sides.
  FlatMap disk;
  int sides = 0;
  std::vector<FlatShape> children{};
  /// The disks and points whose hull a union is; empty if it isn't known to be a hull.
  std::vector<FlatDisk> hull{};
  /// The polygon that OpenSCAD makes of the shape, if that isn't made of its children's polygons.
  FlatLoops facets{};
  /// The shape as a polygon with rounded corners; empty if it isn't known to be one. A shape of
  /// kind kPolygon needs none.
  RoundedPolygon rounded{};

  bool has_curves() const;
};

/// The figure of a module under a map; nothing if it is empty, or wrong, which is reported.
std::optional<FlatShape> flat_shape(const ScadModule& module, const FlatMap& map,
                                    ScadImport& import);
/// The union of the modules in the list that have two dimensions.
std::optional<FlatShape> flat_union(const std::vector<ScadModule>& modules, const FlatMap& map,
                                    ScadImport& import, int line);

/// The figure as outlines that don't cross, with OpenSCAD's sides for round parts; nothing if it is
/// empty. Errors name `line`.
std::optional<FlatLoops> polygon_of(const FlatShape& shape, ScadImport& import, int line);

}  // namespace graycube
