#include "formats/openscad/flat/contact.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flat/side_crossings.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

constexpr int kSides = 256;
/// More than twice the facets' distance from their arc, which is 7.5e-5 radii.
constexpr double kNear = 4e-4;
constexpr std::size_t kMaxShapes = 64;

FlatOperation operation_of(FlatShape::Kind kind) {
  return kind == FlatShape::Kind::kUnion          ? FlatOperation::kUnion
         : kind == FlatShape::Kind::kIntersection ? FlatOperation::kIntersection
                                                  : FlatOperation::kDifference;
}

FlatLoop circle(const FlatMap& map) {
  FlatLoop loop;
  for (int i = 0; i < kSides; ++i)
    loop.push_back(map({cos_degrees(360.0 * i / kSides), sin_degrees(360.0 * i / kSides)}));
  if (map.determinant() < 0) std::reverse(loop.begin(), loop.end());
  return loop;
}

/// Adds the shape as fine polygons; false when these have too many corners.
bool add_fine(const FlatShape& shape, FlatLoops& result) {
  if (shape.kind == FlatShape::Kind::kPolygon) {
    result = shape.loops;
    return true;
  }
  if (shape.kind == FlatShape::Kind::kDisk) {
    result = {circle(shape.disk)};
    return true;
  }
  if (shape.children.size() > kMaxShapes) return false;
  std::vector<FlatLoops> operands;
  for (const FlatShape& child : shape.children) {
    if (!add_fine(child, operands.emplace_back())) return false;
  }
  if (!crossings_are_few(operands)) return false;
  result = combined(operation_of(shape.kind), operands);
  return true;
}

/// The shapes as fine polygons, and the distance that counts as near; none if there are too many.
std::vector<FlatLoops> fine_polygons(std::span<const FlatShape> shapes, double& near) {
  if (shapes.size() > kMaxShapes) return {};
  std::vector<FlatLoops> polygons;
  near = 0;
  for (const FlatShape& shape : shapes) {
    FlatLoops& loops = polygons.emplace_back();
    if (!add_fine(shape, loops)) return {};
    if (loops.empty()) continue;
    const auto [lo, hi] = flat_bounds(loops);
    near = std::max({near, kNear * (hi.x - lo.x), kNear * (hi.y - lo.y)});
  }
  return polygons;
}

FlatLoops grown(const FlatLoops& loops, double distance) {
  if (loops.empty()) return loops;
  return offset_simple(loops, distance, FlatJoin::kSquare, std::fabs(distance));
}

bool boxes_overlap(const FlatLoops& a, const FlatLoops& b) {
  if (a.empty() || b.empty()) return false;
  const auto [a_lo, a_hi] = flat_bounds(a);
  const auto [b_lo, b_hi] = flat_bounds(b);
  return a_lo.x <= b_hi.x && b_lo.x <= a_hi.x && a_lo.y <= b_hi.y && b_lo.y <= a_hi.y;
}

}  // namespace

bool are_apart(std::span<const FlatShape> shapes) {
  double near = 0;
  std::vector<FlatLoops> polygons = fine_polygons(shapes, near);
  if (polygons.empty()) return false;
  for (FlatLoops& loops : polygons) loops = grown(loops, near);
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    for (std::size_t j = i + 1; j < polygons.size(); ++j) {
      if (!boxes_overlap(polygons[i], polygons[j])) continue;
      const FlatLoops both[] = {polygons[i], polygons[j]};
      if (!crossings_are_few(both) || !combined(FlatOperation::kIntersection, both).empty())
        return false;
    }
  }
  return true;
}

bool are_within_first(std::span<const FlatShape> shapes) {
  double near = 0;
  std::vector<FlatLoops> polygons = fine_polygons(shapes, near);
  if (polygons.empty()) return false;
  const FlatLoops core = grown(polygons.front(), -near);
  return std::all_of(polygons.begin() + 1, polygons.end(), [&](const FlatLoops& loops) {
    const FlatLoops both[] = {grown(loops, near), core};
    return crossings_are_few(both) && is_covered(both[0], both[1]);
  });
}

}  // namespace graycube
