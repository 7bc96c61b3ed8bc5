#include "formats/openscad/round_groups.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "formats/openscad/flat/similarity.hpp"
#include "formats/openscad/primitives.hpp"
#include "formats/openscad/sweep.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

using Kind = FlatShape::Kind;

/// How far a facet's ends may be off a circle of radius 1, and its length off that of one of a
/// whole number.
constexpr double kOnCircle = 1e-6;
/// More than that of a triangle.
constexpr double kLongestSide = 1.75;
constexpr double kPi = 3.14159265358979323846;

FlatMap inverse_of(const FlatMap& map) {
  const double det = map.determinant();
  const FlatMap linear{
      {{{map.m[1][1] / det, -map.m[0][1] / det, 0}, {-map.m[1][0] / det, map.m[0][0] / det, 0}}}};
  const FlatPoint back = linear({map.m[0][2], map.m[1][2]});
  FlatMap inverse = linear;
  inverse.m[0][2] = -back.x;
  inverse.m[1][2] = -back.y;
  return inverse;
}

/// The number of facets around a circle of radius 1, one of which is the side from `a` to `b`; 0 if
/// it isn't one.
int sides_by(const FlatPoint& a, const FlatPoint& b) {
  const double chord = std::hypot(b.x - a.x, b.y - a.y);
  if (std::fabs(std::hypot(a.x, a.y) - 1) > kOnCircle ||
      std::fabs(std::hypot(b.x, b.y) - 1) > kOnCircle || !(chord > 10 * kOnCircle) ||
      chord > kLongestSide)
    return 0;
  const double sides = std::round(kPi / std::asin(0.5 * chord));
  if (!(sides <= kMaxOpenscadSides) || std::fabs(2 * sin_degrees(180 / sides) - chord) > kOnCircle)
    return 0;
  return static_cast<int>(sides);
}

/// A disk whose facets are among the outlines' sides: it is turned so that one begins at angle 0.
/// Nothing if there are none.
std::optional<RoundRing> ring_in(const FlatLoops& outlines, const FlatMap& disk,
                                 const Affine& to_world) {
  if (disk.determinant() == 0) return std::nullopt;
  const FlatMap inverse = inverse_of(disk);
  for (const FlatLoop& loop : outlines) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const FlatPoint a = inverse(loop[i]), b = inverse(loop[(i + 1) % loop.size()]);
      const int sides = sides_by(a, b);
      if (sides == 0) continue;
      return cylinder_ring(compose(disk, FlatMap{{{{a.x, -a.y, 0}, {a.y, a.x, 0}}}}), sides,
                           to_world);
    }
  }
  return std::nullopt;
}

void add_rings_in(const FlatLoops& outlines, const FlatShape& shape, const Affine& to_world,
                  RoundGroup& group) {
  if (shape.kind == Kind::kDisk) {
    if (auto ring = ring_in(outlines, shape.disk, to_world)) group.push_back(*std::move(ring));
  }
  for (const FlatShape& child : shape.children) add_rings_in(outlines, child, to_world, group);
}

void add_groups(const FlatShape& shape, const Affine& to_world, std::vector<RoundGroup>& groups) {
  if (!shape.facets.empty()) {
    RoundGroup group;
    add_rings_in(shape.facets, shape, to_world, group);
    if (!group.empty()) groups.push_back(std::move(group));
    return;
  }
  if (shape.kind == Kind::kDisk && shape.sides >= 3)
    groups.push_back({cylinder_ring(shape.disk, shape.sides, to_world)});
  for (const FlatShape& child : shape.children) add_groups(child, to_world, groups);
}

/// Adds the upright sides of a turned polygon, which sweep cylinders.
void add_upright(const FlatLoops& outlines, int steps, const Affine& to_world, RoundGroup& group) {
  for (const FlatLoop& loop : outlines) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const FlatPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if (a.x != b.x || a.x == 0) continue;
      // Steps begin on the negative side.
      group.push_back(cylinder_ring({{{{-a.x, 0, 0}, {0, -a.x, 0}}}}, steps, to_world));
    }
  }
}

void add_turned(const FlatShape& shape, int steps, const Affine& to_world, ScadImport& import,
                RoundGroup& group) {
  if (shape.kind == Kind::kPolygon) return add_upright(shape.loops, steps, to_world, group);
  const auto radius =
      shape.kind == Kind::kDisk ? similarity_scale(shape.disk) : std::optional<double>{};
  const auto circle = radius ? polygon_of(shape, import, 0) : std::nullopt;
  if (circle && !circle->empty()) {
    const FlatPoint center{shape.disk.m[0][2], shape.disk.m[1][2]};
    group.push_back(turned_ring(circle->front(), center, *radius, steps, to_world));
  }
  for (const FlatShape& child : shape.children) add_turned(child, steps, to_world, import, group);
}

void add_operands(const ScadModule& hull, const Affine& to_world, ScadImport& import,
                  RoundGroup& group) {
  for (const ScadModule& child : hull.children) {
    for_each_solid(child, to_world, import.digits, [&](const ScadModule& solid, const Affine& map) {
      if (solid.dimension == 2) return;
      for (RoundGroup& own : round_groups(solid, map, import))
        std::move(own.begin(), own.end(), std::back_inserter(group));
    });
  }
}

}  // namespace

bool is_around_solids(const std::string& name) {
  return name == "group" || name == "union" || name == "render" || name == "color" ||
         name == "difference" || name == "intersection";
}

std::vector<RoundGroup> round_groups(const FlatShape& figure, const Affine& to_world) {
  std::vector<RoundGroup> groups;
  add_groups(figure, to_world, groups);
  return groups;
}

std::vector<RoundGroup> round_groups(const ScadModule& module, const Affine& to_world,
                                     ScadImport& import) {
  if (module.dimension == 2) {
    const auto shape = flat_shape(module, {}, import);
    return shape ? round_groups(*shape, to_world) : std::vector<RoundGroup>{};
  }
  if (const auto round = openscad_round(module)) {
    const double r = round->radius;
    if (round->is_ball) return {{ball_ring(r, round->sides, to_world)}};
    return {{cylinder_ring({{{{r, 0, 0}, {0, r, 0}}}}, round->sides, to_world)}};
  }
  RoundGroup group;
  if (module.name == "linear_extrude") {
    std::optional<PlainSweep> sweep;
    const bool is_plain = plain_sweep(module, import, sweep) && sweep;
    if (is_plain && sweep->scale == FlatPoint{1, 1}) return round_groups(sweep->shape, to_world);
  } else if (module.name == "rotate_extrude") {
    const auto turn = whole_turn(module, import);
    if (turn) add_turned(turn->shape, turn->steps, to_world, import, group);
  } else if (module.name == "hull") {
    add_operands(module, to_world, import, group);
  }
  if (group.empty()) return {};
  return {std::move(group)};
}

}  // namespace graycube
