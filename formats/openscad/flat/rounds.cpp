#include "formats/openscad/flat/rounds.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flat/offset.hpp"
#include "flat/side_crossings.hpp"
#include "formats/openscad/flat/contact.hpp"
#include "formats/openscad/flat/similarity.hpp"

namespace graycube {
namespace {

using Kind = FlatShape::Kind;

/// The facets of offsets used for comparison are this far off the arcs, in distances; anything
/// missing is wider than kMissingWidth.
constexpr double kFineFacets = 1e-4;
constexpr double kMissingWidth = 1e-3;

FlatShape shape_of(const FlatDisk& disk) {
  const double r = disk.radius;
  return {Kind::kDisk, {}, {{{{r, 0, disk.center.x}, {0, r, disk.center.y}}}}, disk.sides, {}};
}

FlatShape shape_of(FlatLoops loops) { return {Kind::kPolygon, std::move(loops), {}, 0, {}}; }

std::optional<FlatDisk> disk_of(const FlatMap& map, int sides) {
  const auto radius = similarity_scale(map);
  if (!radius) return std::nullopt;
  return FlatDisk{{map.m[0][2], map.m[1][2]}, *radius, sides};
}

bool is_convex(const FlatLoops& loops) {
  if (loops.size() != 1) return false;
  const FlatLoop& loop = loops.front();
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (orientation(loop[i], loop[(i + 1) % n], loop[(i + 2) % n]) < 0) return false;
  }
  return true;
}

/// Whether squares and products of such numbers can be told from 0 and infinity.
bool is_sensible(double v) {
  return v == 0 ||
         (std::fabs(v) >= 1 / kMaxOpenscadCoordinate && std::fabs(v) <= kMaxOpenscadCoordinate);
}

bool are_sensible(const FlatLoops& loops) {
  if (loops.empty()) return false;
  const auto [lo, hi] = flat_bounds(loops);
  return is_sensible(
      std::max({std::fabs(lo.x), std::fabs(lo.y), std::fabs(hi.x), std::fabs(hi.y)}));
}

bool are_few_and_sensible(std::span<const FlatDisk> disks) {
  for (const FlatDisk& d : disks) {
    if (!is_sensible(d.radius) ||
        !(std::max(std::fabs(d.center.x), std::fabs(d.center.y)) <= kMaxOpenscadCoordinate))
      return false;
  }
  const auto round = static_cast<std::size_t>(
      std::count_if(disks.begin(), disks.end(), [](const FlatDisk& d) { return d.radius > 0; }));
  return round <= kMaxRoundCorners && round * disks.size() <= kMaxFlatDiskPairs;
}

bool is_before(const FlatPoint& a, const FlatPoint& b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

/// The disks that are points, in order.
FlatLoop points_among(const std::vector<FlatDisk>& disks) {
  FlatLoop points;
  for (const FlatDisk& d : disks) {
    if (d.radius == 0 && d.sides == 0) points.push_back(d.center);
  }
  std::sort(points.begin(), points.end(), is_before);
  return points;
}

/// The hull of disks under the map.
ExactFlat hull_of(const std::vector<FlatDisk>& disks, const FlatMap& map) {
  if (!are_few_and_sensible(disks)) return {};
  const FlatRoundHull hull = flat_round_hull(disks);
  FlatShape result{Kind::kUnion, {}, {}, 0, {}};
  for (const std::size_t i : hull.disks) {
    FlatShape disk = shape_of(disks[i]);
    disk.disk = compose(map, disk.disk);
    result.children.push_back(std::move(disk));
    result.hull.push_back(disks[i]);
  }
  if (hull.polygon.size() >= 3) {
    result.children.push_back(shape_of(mapped(map, FlatLoops{hull.polygon})));
    const FlatLoop points = points_among(disks);
    for (const FlatPoint& p : hull.polygon) {
      if (std::binary_search(points.begin(), points.end(), p, is_before))
        result.hull.push_back({p, 0, 0});
    }
  }
  if (result.children.empty()) return {true, std::nullopt};
  if (result.children.size() == 1) return {true, std::move(result.children.front())};
  if (!(map == FlatMap{})) result.hull.clear();
  return {true, std::move(result)};
}

const FlatShape* first_disk(const FlatShape& shape) {
  if (shape.kind == Kind::kDisk) return &shape;
  for (const FlatShape& child : shape.children) {
    if (const FlatShape* found = first_disk(child)) return found;
  }
  return nullptr;
}

FlatMap inverse_of_linear(const FlatMap& map) {
  const double det = map.determinant();
  return {
      {{{map.m[1][1] / det, -map.m[0][1] / det, 0}, {-map.m[1][0] / det, map.m[0][0] / det, 0}}}};
}

FlatShape united(std::vector<FlatShape> shapes) {
  if (shapes.size() == 1) return std::move(shapes.front());
  return {Kind::kUnion, {}, {}, 0, std::move(shapes)};
}

ExactFlat offset_of_disk(const FlatShape& shape, double distance) {
  auto disk = disk_of(shape.disk, shape.sides);
  if (!disk) return {};
  // Only a rotation remains of the map, so that only the radius changes.
  if (!(disk->radius + distance > 0)) return {true, std::nullopt};
  disk->radius += distance;
  return {true, shape_of(*disk)};
}

ExactFlat offset_of_polygon(const FlatShape& shape, double distance, int sides) {
  if (!are_sensible(shape.loops)) return {};
  auto offset = round_offset(shape.loops, distance);
  if (!offset) return {};
  std::vector<FlatShape> parts;
  if (!offset->polygon.empty()) parts.push_back(shape_of(std::move(offset->polygon)));
  if (distance < 0 && parts.empty()) return {true, std::nullopt};
  for (const FlatPoint& center : offset->centers)
    parts.push_back(shape_of(FlatDisk{center, std::fabs(distance), sides}));
  if (distance > 0 || parts.size() == 1) return {true, united(std::move(parts))};
  return {true, FlatShape{Kind::kDifference, {}, {}, 0, std::move(parts)}};
}

FlatShape shape_of(RoundedPolygon rounded, int sides) {
  RoundedParts parts = parts_of(rounded, sides);
  std::vector<FlatShape> added;
  added.push_back(shape_of(resolved(parts.polygon)));
  for (const FlatDisk& disk : parts.added) added.push_back(shape_of(disk));
  FlatShape result = united(std::move(added));
  if (!parts.removed.empty()) {
    std::vector<FlatShape> all;
    all.push_back(std::move(result));
    for (const FlatDisk& disk : parts.removed) all.push_back(shape_of(disk));
    result = {Kind::kDifference, {}, {}, 0, std::move(all)};
  }
  if (result.kind != Kind::kPolygon) result.rounded = std::move(rounded);
  return result;
}

/// The moved outline; empty if it isn't known, or if it isn't the offset because parts of it meet.
/// Clipper's offset shows that, with facets much finer than the parts that could be missing.
RoundedPolygon moved_outline(const FlatShape& shape, double distance, bool is_round) {
  if (shape.kind == Kind::kPolygon && !are_sensible(shape.loops)) return {};
  const RoundedPolygon given =
      shape.kind == Kind::kPolygon ? sharp_polygon(shape.loops) : shape.rounded;
  if (given.empty()) return {};
  auto result = moved(given, distance, is_round);
  if (!result) return {};
  const double fine = kFineFacets * std::fabs(distance);
  const FlatLoops before = outline_of(given, fine), after = outline_of(*result, fine);
  // If sides cross, however little, parts have met.
  if (!crossings_are_few(std::span(&after, 1)) || resolved_count(after) != after.size()) return {};
  const FlatLoops expected =
      offset_simple(before, distance, is_round ? FlatJoin::kRound : FlatJoin::kMiter, fine);
  if (!are_alike(after, expected, kMissingWidth * std::fabs(distance))) return {};
  return *std::move(result);
}

/// Growing distributes over unions, shrinking over intersections and over subtraction: A − B
/// shrunk is A shrunk − B grown. Shrinking distributes over a union of shapes that are
/// apart, and growing over holes that are apart and reach the outline nowhere. If sharp
/// corners stay sharp, each outline moves by itself, which is the same as long as no two
/// meet.
bool distributes(const FlatShape& shape, double distance, FlatCorners corners) {
  const std::span<const FlatShape> all(shape.children);
  const bool is_round = corners == FlatCorners::kRound;
  if (shape.kind == Kind::kUnion) return (is_round && distance > 0) || are_apart(all);
  if (is_round && distance < 0) return true;
  return shape.kind == Kind::kDifference && are_within_first(all) && are_apart(all.subspan(1));
}

ExactFlat offset_of_operation(const FlatShape& shape, double distance, int sides,
                              FlatCorners corners) {
  if (!distributes(shape, distance, corners)) return {};
  FlatShape result{shape.kind, {}, {}, 0, {}};
  for (std::size_t i = 0; i < shape.children.size(); ++i) {
    const bool is_taken_off = shape.kind == Kind::kDifference && i > 0;
    ExactFlat child =
        exact_offset(shape.children[i], is_taken_off ? -distance : distance, sides, corners);
    if (!child.is_exact) return {};
    if (child.shape) {
      result.children.push_back(*std::move(child.shape));
    } else if (!is_taken_off && shape.kind != Kind::kUnion) {
      return {true, std::nullopt};
    }
  }
  if (result.children.empty()) return {true, std::nullopt};
  if (result.children.size() == 1) return {true, std::move(result.children.front())};
  return {true, std::move(result)};
}

}  // namespace

FlatShape mapped(const FlatMap& map, FlatShape shape) {
  if (map == FlatMap{}) return shape;
  shape.loops = mapped(map, std::move(shape.loops));
  shape.facets = mapped(map, std::move(shape.facets));
  if (shape.kind == Kind::kDisk) shape.disk = compose(map, shape.disk);
  const auto scale = similarity_scale(map);
  if (!scale) shape.hull.clear();
  for (FlatDisk& disk : shape.hull) disk = {map(disk.center), *scale * disk.radius, disk.sides};
  if (!scale || map.determinant() < 0) shape.rounded.clear();
  for (RoundedLoop& loop : shape.rounded) {
    for (FlatPoint& corner : loop.corners) corner = map(corner);
    for (double& radius : loop.radii) radius *= *scale;
  }
  for (FlatShape& child : shape.children) child = mapped(map, std::move(child));
  return shape;
}

std::vector<FlatDisk> disks_of_convex(const FlatShape& shape) {
  if (!shape.hull.empty()) return shape.hull;
  std::vector<FlatDisk> disks;
  if (shape.kind == Kind::kDisk) {
    if (const auto disk = disk_of(shape.disk, shape.sides)) disks.push_back(*disk);
  } else if (shape.kind == Kind::kPolygon && is_convex(shape.loops)) {
    for (const FlatPoint& p : shape.loops.front()) disks.push_back({p, 0, 0});
  }
  return disks;
}

bool add_hull_disks(const FlatShape& shape, const FlatMap& map, std::vector<FlatDisk>& disks) {
  if (shape.kind == Kind::kPolygon) {
    for (const FlatLoop& loop : shape.loops) {
      for (const FlatPoint& p : loop) disks.push_back({map(p), 0, 0});
    }
    return true;
  }
  if (shape.kind == Kind::kDisk) {
    const auto disk = disk_of(compose(map, shape.disk), shape.sides);
    if (disk) disks.push_back(*disk);
    return disk.has_value();
  }
  if (shape.kind == Kind::kDifference && are_within_first(shape.children)) {
    return add_hull_disks(shape.children.front(), map, disks);
  }
  if (shape.kind != Kind::kUnion) return false;
  return std::all_of(shape.children.begin(), shape.children.end(),
                     [&](const FlatShape& child) { return add_hull_disks(child, map, disks); });
}

ExactFlat hull_of_disks(const std::vector<FlatDisk>& disks) { return hull_of(disks, {}); }

ExactFlat exact_flat_hull(std::span<const FlatShape> parts) {
  const auto as_seen_from = [&](const FlatMap& map, const FlatMap& back) -> ExactFlat {
    std::vector<FlatDisk> disks;
    const bool is_known = std::all_of(parts.begin(), parts.end(), [&](const FlatShape& part) {
      return add_hull_disks(part, back, disks);
    });
    return is_known ? hull_of(disks, map) : ExactFlat{};
  };
  if (ExactFlat hull = as_seen_from({}, {}); hull.is_exact) return hull;
  // The disks are ellipses that are images of circles under one map.
  for (const FlatShape& part : parts) {
    const FlatShape* disk = first_disk(part);
    if (disk == nullptr || disk->disk.determinant() == 0) continue;
    FlatMap linear = disk->disk;
    linear.m[0][2] = linear.m[1][2] = 0;
    return as_seen_from(linear, inverse_of_linear(linear));
  }
  return {};
}

ExactFlat exact_offset(const FlatShape& shape, double distance, int sides, FlatCorners corners) {
  if (distance == 0) return {true, shape};
  if (!is_sensible(distance)) return {};
  if (shape.kind == Kind::kDisk) return offset_of_disk(shape, distance);
  const bool is_round = corners == FlatCorners::kRound;
  RoundedPolygon rounded = moved_outline(shape, distance, is_round);
  std::vector<FlatDisk> disks = disks_of_convex(shape);
  // Without sharp corners both kinds of offset are the same.
  const auto is_smooth = [&](const FlatDisk& d) { return is_round || d.radius > 0; };
  if (!std::all_of(disks.begin(), disks.end(), is_smooth)) disks.clear();
  const auto stays = [&](const FlatDisk& d) { return d.radius + distance >= 0; };
  if (!disks.empty() && std::all_of(disks.begin(), disks.end(), stays)) {
    for (FlatDisk& d : disks) d = {d.center, d.radius + distance, d.sides > 0 ? d.sides : sides};
    ExactFlat hull = hull_of(disks, {});
    if (hull.shape && hull.shape->kind == Kind::kUnion) hull.shape->rounded = std::move(rounded);
    return hull;
  }
  if (!rounded.empty()) return {true, shape_of(std::move(rounded), sides)};
  if (shape.kind != Kind::kPolygon) return offset_of_operation(shape, distance, sides, corners);
  return is_round ? offset_of_polygon(shape, distance, sides) : ExactFlat{};
}

}  // namespace graycube
