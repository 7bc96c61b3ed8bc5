#include "formats/openscad/flat/sums.hpp"

#include <algorithm>
#include <utility>

#include "flat/offset.hpp"
#include "flat/side_crossings.hpp"

namespace graycube {
namespace {

using Kind = FlatShape::Kind;

FlatShape shape_of(FlatLoops loops) { return {Kind::kPolygon, std::move(loops), {}, 0, {}}; }

FlatShape united(std::vector<FlatShape> shapes) {
  if (shapes.size() == 1) return std::move(shapes.front());
  return {Kind::kUnion, {}, {}, 0, std::move(shapes)};
}

ExactFlat sum_of_disks(const std::vector<FlatDisk>& a, const std::vector<FlatDisk>& b) {
  if (a.size() * b.size() > kMaxFlatDiskPairs / kMaxRoundCorners) return {};
  std::vector<FlatDisk> sums;
  for (const FlatDisk& p : a) {
    for (const FlatDisk& q : b) {
      const FlatPoint center{p.center.x + q.center.x, p.center.y + q.center.y};
      sums.push_back({center, p.radius + q.radius, std::max(p.sides, q.sides)});
    }
  }
  return hull_of_disks(sums);
}

/// The sum of any polygon and a convex figure: the figure swept along each side, and the polygon
/// moved to a point of the figure.
ExactFlat sum_of_polygon(const FlatShape& polygon, const std::vector<FlatDisk>& convex) {
  std::size_t corners = 0;
  for (const FlatLoop& loop : polygon.loops) corners += loop.size();
  if (corners > kMaxRoundCorners || corners * convex.size() > kMaxFlatDiskPairs / kMaxRoundCorners)
    return {};
  const FlatPoint to = convex.front().center;
  std::vector<FlatShape> parts;
  std::vector<FlatLoops> straight{mapped(FlatMap{{{{1, 0, to.x}, {0, 1, to.y}}}}, polygon.loops)};
  for (const FlatLoop& loop : polygon.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::vector<FlatDisk> side{{loop[i], 0, 0}, {loop[(i + 1) % loop.size()], 0, 0}};
      ExactFlat swept = sum_of_disks(side, convex);
      if (!swept.is_exact) return {};
      if (!swept.shape) continue;
      if (swept.shape->kind == Kind::kPolygon) {
        straight.push_back(std::move(swept.shape->loops));
      } else {
        parts.push_back(*std::move(swept.shape));
      }
    }
  }
  if (!crossings_are_few(straight)) return {};
  parts.push_back(shape_of(combined(FlatOperation::kUnion, straight)));
  return {true, united(std::move(parts))};
}

/// Sums distribute over unions.
ExactFlat sum_with_union(const FlatShape& whole, const FlatShape& other) {
  std::vector<FlatShape> parts;
  for (const FlatShape& child : whole.children) {
    ExactFlat part = exact_flat_sum(child, other);
    if (!part.is_exact) return {};
    if (part.shape) parts.push_back(*std::move(part.shape));
  }
  if (parts.empty()) return {true, std::nullopt};
  return {true, united(std::move(parts))};
}

}  // namespace

ExactFlat exact_flat_sum(const FlatShape& a, const FlatShape& b) {
  const std::vector<FlatDisk> first = disks_of_convex(a), second = disks_of_convex(b);
  if (!first.empty() && !second.empty()) return sum_of_disks(first, second);
  for (const auto& [whole, disk] : {std::pair{&a, &b}, std::pair{&b, &a}}) {
    const std::vector<FlatDisk> round =
        disk->kind == Kind::kDisk ? disks_of_convex(*disk) : std::vector<FlatDisk>{};
    if (round.empty()) continue;
    const auto& [center, radius, sides] = round.front();
    ExactFlat grown = exact_offset(*whole, radius, sides);
    const FlatMap shift{{{{1, 0, center.x}, {0, 1, center.y}}}};
    if (grown.shape) grown.shape = mapped(shift, *std::move(grown.shape));
    return grown;
  }
  if (a.kind == Kind::kPolygon && !second.empty()) return sum_of_polygon(a, second);
  if (b.kind == Kind::kPolygon && !first.empty()) return sum_of_polygon(b, first);
  if (a.kind == Kind::kUnion && a.hull.empty()) return sum_with_union(a, b);
  if (b.kind == Kind::kUnion && b.hull.empty()) return sum_with_union(b, a);
  return {};
}

}  // namespace graycube
