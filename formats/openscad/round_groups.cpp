#include "formats/openscad/round_groups.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "formats/openscad/hulls/ring_sums.hpp"
#include "formats/openscad/language/module_kinds.hpp"
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
/// Turned outlines of more sides stand for curves, whose slanted sides are not looked at.
constexpr std::size_t kMostTurnedSides = 512;
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

/// A disk and the facets that it has.
struct FacetedDisk {
  FlatMap map;
  int sides = 0;
};

/// A disk whose facets are among the outlines' sides: it is turned so that one begins at angle 0.
/// Nothing if there are none.
std::optional<FacetedDisk> disk_in(const FlatLoops& outlines, const FlatMap& disk) {
  if (disk.determinant() == 0) return std::nullopt;
  const FlatMap inverse = inverse_of(disk);
  for (const FlatLoop& loop : outlines) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const FlatPoint a = inverse(loop[i]), b = inverse(loop[(i + 1) % loop.size()]);
      const int sides = sides_by(a, b);
      if (sides == 0) continue;
      return FacetedDisk{compose(disk, FlatMap{{{{a.x, -a.y, 0}, {a.y, a.x, 0}}}}), sides};
    }
  }
  return std::nullopt;
}

/// Calls visit(disk) for each disk of a figure that has facets of its own. `outlines`: the facets
/// that it has together with others, if there are such.
template <typename Visit>
void for_each_disk(const FlatShape& shape, const Visit& visit,
                   const FlatLoops* outlines = nullptr) {
  if (outlines == nullptr && !shape.facets.empty()) outlines = &shape.facets;
  if (shape.kind == Kind::kDisk) {
    if (outlines != nullptr) {
      if (const auto disk = disk_in(*outlines, shape.disk)) visit(*disk);
    } else if (shape.sides >= 3) {
      visit(FacetedDisk{shape.disk, shape.sides});
    }
  }
  for (const FlatShape& child : shape.children) for_each_disk(child, visit, outlines);
}

/// Calls visit(outlines) for each polygon of a figure.
template <typename Visit>
void for_each_polygon(const FlatShape& shape, const Visit& visit) {
  if (shape.kind == Kind::kPolygon) visit(shape.loops);
  for (const FlatShape& child : shape.children) for_each_polygon(child, visit);
}

FlatLoop corners_of(const FacetedDisk& disk) {
  FlatLoop corners;
  for (const double angle : whole_ring(disk.sides).degrees)
    corners.push_back(disk.map({cos_degrees(angle), sin_degrees(angle)}));
  return corners;
}

/// The cylinders of a figure that is extruded upright. Disks that have facets together are in one
/// group.
void add_upright(const FlatShape& shape, const Affine& to_world, std::vector<RoundGroup>& groups) {
  if (shape.kind != Kind::kDisk && shape.facets.empty()) {
    for (const FlatShape& child : shape.children) add_upright(child, to_world, groups);
    return;
  }
  RoundGroup group;
  for_each_disk(shape, [&](const FacetedDisk& disk) {
    group.push_back(cylinder_ring(disk.map, whole_ring(disk.sides), to_world));
  });
  if (!group.empty()) groups.push_back(std::move(group));
}

/// Adds a side of a turned outline, which sweeps a cylinder or a cone.
void add_side(const FlatPoint& a, const FlatPoint& b, const RingAngles& angles,
              const Affine& to_world, RoundGroup& group) {
  const FlatPoint &wide = std::fabs(a.x) < std::fabs(b.x) ? b : a, &narrow = &wide == &a ? b : a;
  if (a.y == b.y || wide.x == 0) return;
  const FlatMap disk{{{{wide.x, 0, 0}, {0, wide.x, 0}}}};
  if (a.x == b.x) {
    group.push_back(cylinder_ring(disk, angles, to_world));
  } else if (narrow.x * wide.x >= 0) {
    group.push_back(cone_ring(disk, wide.y, {0, 0, narrow.y}, narrow.x / wide.x, angles, to_world));
  }
}

void add_sides(const FlatLoops& outlines, const RingAngles& angles, const Affine& to_world,
               RoundGroup& group) {
  std::size_t corners = 0;
  for (const FlatLoop& loop : outlines) corners += loop.size();
  const bool is_curve = corners > kMostTurnedSides;
  for (const FlatLoop& loop : outlines) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const FlatPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
      if (!is_curve || a.x == b.x) add_side(a, b, angles, to_world, group);
    }
  }
}

void add_turned(const FlatShape& shape, const RingAngles& angles, const Affine& to_world,
                RoundGroup& group) {
  for_each_disk(shape, [&](const FacetedDisk& disk) {
    const auto& m = disk.map.m;
    const FlatPoint reach{std::sqrt(m[0][0] * m[0][0] + m[0][1] * m[0][1]),
                          std::sqrt(m[1][0] * m[1][0] + m[1][1] * m[1][1])};
    const FlatLoop corners = corners_of(disk);
    group.push_back(turned_ring(corners, {m[0][2], m[1][2]}, reach, angles, to_world));
    // An outline of facets that is turned shares cones with it.
    add_sides({corners}, angles, to_world, group);
  });
  for_each_polygon(
      shape, [&](const FlatLoops& outlines) { add_sides(outlines, angles, to_world, group); });
}

/// The cones of an extrusion that grows or shrinks evenly; all get facets together.
void add_tapered(const PlainSweep& sweep, const Affine& to_world, RoundGroup& group) {
  const double scale = sweep.scale.x;
  const bool is_wide_above = scale > 1;
  for_each_disk(sweep.shape, [&](const FacetedDisk& disk) {
    const FlatMap above = compose({{{{scale, 0, 0}, {0, scale, 0}}}}, disk.map);
    const FlatMap &wide = is_wide_above ? above : disk.map,
                  &other = is_wide_above ? disk.map : above;
    const double wide_z = is_wide_above ? sweep.high : sweep.low;
    const double other_z = is_wide_above ? sweep.low : sweep.high;
    group.push_back(cone_ring(wide, wide_z, {other.m[0][2], other.m[1][2], other_z},
                              is_wide_above ? 1 / scale : scale, whole_ring(disk.sides), to_world));
  });
}

RoundRing ring_of(const ScadRound& round, const Affine& to_world) {
  if (round.is_ball) return ball_ring(round.radius, round.sides, to_world);
  const bool is_wide_above = round.top_radius > round.radius;
  const double wide = is_wide_above ? round.top_radius : round.radius;
  const double narrow = is_wide_above ? round.radius : round.top_radius;
  const FlatMap disk{{{{wide, 0, 0}, {0, wide, 0}}}};
  const RingAngles angles = whole_ring(round.sides);
  if (wide == narrow) return cylinder_ring(disk, angles, to_world);
  return cone_ring(disk, is_wide_above ? round.high : round.low,
                   {0, 0, is_wide_above ? round.low : round.high}, narrow / wide, angles, to_world);
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

bool add_operand(const ScadModule& module, const Affine& to_world, ScadImport& import,
                 SumOperand& operand);

bool add_operands_of_all(const ScadModule& module, const Affine& to_world, ScadImport& import,
                         SumOperand& operand) {
  return std::all_of(module.children.begin(), module.children.end(), [&](const ScadModule& child) {
    return add_operand(child, to_world, import, operand);
  });
}

/// The sum of a minkowski()'s operands; nothing if one isn't known, or if it is too large.
std::optional<SumOperand> operand_of_sum(const ScadModule& module, const Affine& to_world,
                                         ScadImport& import) {
  std::optional<SumOperand> sum;
  for (const ScadModule& child : module.children) {
    if (child.left_out || child.dimension == 2) continue;
    SumOperand operand;
    if (!add_operand(child, to_world, import, operand)) return std::nullopt;
    if (!sum) {
      sum = std::move(operand);
    } else if (!add_to_sum(*sum, operand, to_world.point({}), placing_share(import.digits))) {
      return std::nullopt;
    }
  }
  return sum;
}

/// The corners of an extrusion's polygons.
std::vector<Vec3> corners_of(const PlainSweep& sweep) {
  std::vector<Vec3> corners;
  for_each_polygon(sweep.shape, [&](const FlatLoops& outlines) {
    for (const FlatLoop& loop : outlines) {
      for (const FlatPoint& p : loop) {
        corners.push_back({p.x, p.y, sweep.low});
        corners.push_back({sweep.scale.x * p.x, sweep.scale.y * p.y, sweep.high});
      }
    }
  });
  return corners;
}

/// What is round, and the corners of what isn't, in a primitive or an extrusion.
SumOperand operand_of(const ScadModule& module, const Affine& to_world, ScadImport& import) {
  SumOperand operand;
  for (RoundGroup& group : round_groups(module, to_world, import))
    std::move(group.begin(), group.end(), std::back_inserter(operand.rings));
  std::vector<Vec3> corners;
  std::optional<PlainSweep> sweep;
  if (module.name == "polyhedron") {
    corners = polyhedron_corners(module, import.report);
  } else if (is_openscad_primitive(module)) {
    if (const auto solid = openscad_primitive(module, import.report)) corners = solid->corners;
  } else if (module.name == "linear_extrude" && plain_sweep(module, import, sweep) && sweep) {
    corners = corners_of(*sweep);
  }
  for (const Vec3& p : corners) operand.corners.push_back(to_world.point(p));
  return operand;
}

/// Adds what is in a module; false if that isn't known.
bool add_operand(const ScadModule& module, const Affine& to_world, ScadImport& import,
                 SumOperand& operand) {
  const std::string& name = module.name;
  if (module.left_out || module.dimension == 2) return true;
  if (name == "multmatrix") {
    const auto own = openscad_matrix(module, import.digits, import.report);
    return !own || add_operands_of_all(module, compose(to_world, *own), import, operand);
  }
  if (name == "group" || name == "union" || name == "color" || name == "render" || name == "hull")
    return add_operands_of_all(module, to_world, import, operand);
  std::optional<SumOperand> own;
  if (name == "minkowski") {
    own = operand_of_sum(module, to_world, import);
  } else if (is_openscad_primitive(module) || is_extrusion(name)) {
    own = operand_of(module, to_world, import);
  }
  if (!own || own->size() + operand.size() > kMostSumCorners) return false;
  std::move(own->rings.begin(), own->rings.end(), std::back_inserter(operand.rings));
  operand.corners.insert(operand.corners.end(), own->corners.begin(), own->corners.end());
  return true;
}

}  // namespace

bool is_around_solids(const std::string& name) {
  return name == "group" || name == "union" || name == "render" || name == "color" ||
         name == "difference" || name == "intersection";
}

std::vector<RoundGroup> round_groups(const FlatShape& figure, const Affine& to_world) {
  std::vector<RoundGroup> groups;
  add_upright(figure, to_world, groups);
  return groups;
}

std::vector<RoundGroup> round_groups(const ScadModule& module, const Affine& to_world,
                                     ScadImport& import) {
  if (module.dimension == 2) {
    const auto shape = flat_shape(module, {}, import);
    return shape ? round_groups(*shape, to_world) : std::vector<RoundGroup>{};
  }
  if (const auto round = openscad_round(module)) return {{ring_of(*round, to_world)}};
  RoundGroup group;
  if (module.name == "linear_extrude") {
    std::optional<PlainSweep> sweep;
    if (!plain_sweep(module, import, sweep) || !sweep || sweep->scale.x != sweep->scale.y)
      return {};
    if (sweep->scale.x == 1) return round_groups(sweep->shape, to_world);
    add_tapered(*sweep, to_world, group);
  } else if (module.name == "rotate_extrude") {
    const auto turn = round_turn(module, import);
    if (turn)
      add_turned(turn->shape, turn_ring(turn->start, turn->angle, turn->steps), to_world, group);
  } else if (module.name == "hull") {
    add_operands(module, to_world, import, group);
  } else if (module.name == "minkowski") {
    if (auto sum = operand_of_sum(module, to_world, import)) group = std::move(sum->rings);
  }
  if (group.empty()) return {};
  return {std::move(group)};
}

}  // namespace graycube
