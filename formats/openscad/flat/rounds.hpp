// hull() and offset() of flat shapes with round parts exact, if the result has a form in disks and
// polygons.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "formats/openscad/flat/shape.hpp"

namespace graycube {

/// A result that may be empty; without an exact form `is_exact` is false, and there is no shape.
struct ExactFlat {
  bool is_exact = false;
  std::optional<FlatShape> shape;
};

/// The disks and points whose hull the shape is; empty where it isn't known to be convex.
std::vector<FlatDisk> disks_of_convex(const FlatShape& shape);

/// Adds the disks and points whose hull is that of the shape under a map; false if it needs others.
bool add_hull_disks(const FlatShape& shape, const FlatMap& map, std::vector<FlatDisk>& disks);

ExactFlat hull_of_disks(const std::vector<FlatDisk>& disks);
/// The hull of all shapes together.
ExactFlat exact_flat_hull(std::span<const FlatShape> parts);
/// offset(r = distance), or offset(delta = distance), with which sharp corners stay sharp; corners
/// that become round have `sides` sides in OpenSCAD.
enum class FlatCorners : std::uint8_t { kRound, kSharp };
ExactFlat exact_offset(const FlatShape& shape, double distance, int sides,
                       FlatCorners corners = FlatCorners::kRound);
FlatShape mapped(const FlatMap& map, FlatShape shape);

}  // namespace graycube
