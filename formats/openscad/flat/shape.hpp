// The two-dimensional part of a .csg file: squares, circles, polygons, what is made of them, and
// what comes of the rest as polygons.
#pragma once

#include <optional>
#include <vector>

#include "flat/polygon.hpp"
#include "flat/rounded_polygon.hpp"
#include "flat/rounds.hpp"
#include "formats/openscad/language/import.hpp"

namespace graycube {

/// A figure that isn't empty. Circles and their images stay what they are; operations remain only
/// above them.
struct FlatShape {
  enum class Kind : std::uint8_t { kPolygon, kDisk, kUnion, kIntersection, kDifference };
  Kind kind = Kind::kPolygon;
  /// Of a polygon.
  FlatLoops loops;
  /// A disk is the image of the unit disk; OpenSCAD gives it so many sides.
  FlatMap disk;
  int sides = 0;
  std::vector<FlatShape> children{};
  /// The disks and points whose hull a union is; empty where it isn't known to be one.
  std::vector<FlatDisk> hull{};
  /// OpenSCAD's polygon for it where that isn't made of its children's.
  FlatLoops facets{};
  /// The shape as a polygon with rounded corners; empty where it isn't known as one. Polygons are
  /// such themselves.
  RoundedPolygon rounded{};

  bool has_curves() const;
};

/// The figure of a module under a map; nothing where it is empty or wrong, which is reported.
std::optional<FlatShape> flat_shape(const ScadModule& module, const FlatMap& map,
                                    ScadImport& import);
/// The union of the modules in the list that have two dimensions.
std::optional<FlatShape> flat_union(const std::vector<ScadModule>& modules, const FlatMap& map,
                                    ScadImport& import, int line);

/// The figure with OpenSCAD's sides for what is round, resolved; nothing where it is empty. `line`
/// for an error.
std::optional<FlatLoops> polygon_of(const FlatShape& shape, ScadImport& import, int line);

}  // namespace graycube
