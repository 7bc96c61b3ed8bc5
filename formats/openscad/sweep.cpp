#include "formats/openscad/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flat/side_crossings.hpp"
#include "formats/openscad/extrusions/sweep_arguments.hpp"
#include "formats/openscad/extrusions/sweep_mesh.hpp"
#include "formats/openscad/flat/rounds.hpp"
#include "formats/openscad/flat/similarity.hpp"
#include "formats/openscad/hulls/round_solid.hpp"
#include "formats/openscad/kept_figures.hpp"
#include "formats/openscad/language/arguments.hpp"
#include "formats/openscad/primitives.hpp"
#include "geometry/portable_math.hpp"
#include "scene/flat_solids.hpp"
#include "scene/limits.hpp"

namespace graycube {
namespace {

using Kind = FlatShape::Kind;

/// The length by which subtracted solids reach beyond the ends, in heights.
constexpr double kReachBeyond = 0.25;

CsgNode leaf(decltype(CsgNode::value) value) {
  return {std::move(value), std::nullopt, kInheritMaterial};
}

CsgNode operation(Operation kind, std::vector<CsgNode> children) {
  if (children.size() == 1) return std::move(children.front());
  return leaf(OperationNode{kind, std::move(children)});
}

Operation operation_of(Kind kind) {
  return kind == Kind::kUnion          ? Operation::kUnion
         : kind == Kind::kIntersection ? Operation::kIntersection
                                       : Operation::kDifference;
}

/// Does the operation of figures with their solids: `solid_of(child, is_first)`.
template <typename SolidOf>
std::optional<CsgNode> operated(const FlatShape& shape, const SolidOf& solid_of) {
  std::vector<CsgNode> children;
  for (std::size_t i = 0; i < shape.children.size(); ++i) {
    auto child = solid_of(shape.children[i], i == 0);
    if (child) {
      children.push_back(std::move(*child));
    } else if (shape.kind == Kind::kIntersection || (shape.kind == Kind::kDifference && i == 0)) {
      return std::nullopt;
    }
  }
  if (children.empty()) return std::nullopt;
  return operation(operation_of(shape.kind), std::move(children));
}

FlatPoint center_of(const FlatMap& map) { return {map.m[0][2], map.m[1][2]}; }

CsgNode extruded_disk(const FlatMap& map, double low, double high) {
  const FlatPoint c = center_of(map);
  if (const auto radius = similarity_scale(map)) {
    return leaf(CylinderShape{{c.x, c.y, low}, {c.x, c.y, high}, *radius});
  }
  CsgNode node = leaf(CylinderShape{{0, 0, low}, {0, 0, high}, 1});
  const auto& m = map.m;
  node.transform = Affine{{{{m[0][0], m[0][1], 0, c.x}, {m[1][0], m[1][1], 0, c.y}, {0, 0, 1, 0}}}};
  return node;
}

/// The prism of a figure that has too many corners for one of a scene file.
std::optional<CsgNode> extruded_mesh(const FlatLoops& part, double low, double high,
                                     ScadImport& import, int line) {
  LinearSweep sweep;
  sweep.low = low;
  sweep.high = high;
  const auto meshes = swept(part, sweep);
  if (!meshes || meshes->size() != 1) {
    import.report.leave_out("crossing figure", line, "a figure is left out: its outlines cross");
    return std::nullopt;
  }
  ScadModule extrusion;
  extrusion.name = "linear_extrude";
  extrusion.line = line;
  return mesh_leaf(meshes->front(), extrusion, import.report);
}

/// One prism for each connected part, so that few have more corners than a scene file allows.
std::optional<CsgNode> extruded_polygon(const FlatLoops& loops, double low, double high,
                                        ScadImport& import, int line) {
  std::vector<CsgNode> prisms;
  for (FlatRegion& region : regions_of(loops)) {
    FlatLoops part = std::move(region.holes);
    part.insert(part.begin(), std::move(region.outline));
    std::size_t corners = 0;
    for (const FlatLoop& loop : part) corners += loop.size();
    if (!crossings_are_few(std::span(&part, 1))) {
      import.leave_out_once("outline", line,
                            "a figure is left out: its outline crosses itself too often");
      return std::nullopt;
    }
    if (corners > kMaxPrismPoints) {
      auto mesh = extruded_mesh(part, low, high, import, line);
      if (mesh) prisms.push_back(std::move(*mesh));
      continue;
    }
    // Slivers left by rounding may be lost.
    if (prism_of(part, low, high)) prisms.push_back(leaf(prism_shape(part, low, high)));
  }
  if (prisms.empty()) return std::nullopt;
  return operation(Operation::kUnion, std::move(prisms));
}

/// An ellipse with semi-axes (outward, upward) and, across it, `across`.
struct Ellipse {
  double outward, upward, across;
};
Ellipse ellipse_of(const FlatMap& map) {
  const double a = map.m[0][0], b = map.m[0][1], c = map.m[1][0], d = map.m[1][1];
  // M Mᵀ = [p q; q s]; its larger eigenvalue is the square of the longer semi-axis.
  const double p = a * a + b * b, q = a * c + b * d, s = c * c + d * d;
  const double root = std::sqrt(0.25 * (p - s) * (p - s) + q * q);
  const double most = 0.5 * (p + s) + root, least = std::fabs(a * d - b * c) / std::sqrt(most);
  FlatPoint axis = p > s ? FlatPoint{most - s, q} : FlatPoint{q, most - p};
  const double l = std::sqrt(axis.x * axis.x + axis.y * axis.y);
  if (!(l > 0)) axis = {1, 0};
  const double scale = std::sqrt(most) / (l > 0 ? l : 1);
  return {scale * axis.x, scale * axis.y, least};
}

/// A disk turned about the y axis, which becomes z; nothing if it is neither torus nor sphere.
std::optional<CsgNode> turned_disk(const FlatMap& map) {
  const FlatPoint c = center_of(map);
  const auto radius = similarity_scale(map);
  if (radius) {
    if (std::fabs(c.x) <= 1e-12 * *radius) return leaf(SphereShape{{0, 0, c.y}, *radius});
    if (*radius < c.x) return leaf(TorusShape{{0, 0, c.y}, {0, 0, 1}, c.x, *radius});
    return std::nullopt;
  }
  const Ellipse e = ellipse_of(map);
  const double long2 = e.outward * e.outward + e.upward * e.upward;
  const double reach2 = e.outward * e.outward + e.across * e.across * e.upward * e.upward / long2;
  if (!(std::sqrt(reach2) < c.x)) return std::nullopt;
  return leaf(EllipticTorusShape{{0, 0, c.y}, {0, 0, 1}, c.x, e.outward, e.upward, e.across});
}

bool has_turned_form(const FlatShape& shape) {
  if (shape.kind == Kind::kDisk) return turned_disk(shape.disk).has_value();
  return std::all_of(shape.children.begin(), shape.children.end(), has_turned_form);
}

std::optional<CsgNode> turned_shape(const FlatShape& shape, ScadImport& import, int line) {
  if (shape.kind == Kind::kPolygon) return turned(shape.loops);
  // Disks to which other parts are tangent get facets together with these.
  if (shape.kind != Kind::kDisk && (shape.facets.empty() || has_turned_form(shape))) {
    return operated(
        shape, [&](const FlatShape& child, bool) { return turned_shape(child, import, line); });
  }
  if (shape.kind == Kind::kDisk) {
    if (auto solid = turned_disk(shape.disk)) return solid;
  }
  import.warn_once(line, "rotate_extrude() takes circles that reach the axis by OpenSCAD's sides");
  const auto loops = polygon_of(shape, import, line);
  return loops ? turned(*loops) : std::nullopt;
}

/// The wedge from `from` to `to` degrees about z, which are less than 360 apart.
CsgNode wedge(double from, double to) {
  std::vector<CsgNode> sides;
  // The points left of the half-plane at `from` and right of that at `to`.
  sides.push_back(leaf(HalfSpaceShape{{sin_degrees(from), -cos_degrees(from), 0}, 0}));
  sides.push_back(leaf(HalfSpaceShape{{-sin_degrees(to), cos_degrees(to), 0}, 0}));
  return operation(to - from <= 180 ? Operation::kIntersection : Operation::kUnion,
                   std::move(sides));
}

std::optional<FlatShape> figure_of(const ScadModule& module, ScadImport& import) {
  if (import.figures != nullptr) return import.figures->figure(module, import);
  return flat_union(module.children, {}, import, module.line);
}

/// A convex figure that shrinks evenly sweeps the hull of its two ends: a cone for a circle.
std::optional<CsgNode> tapered(const FlatShape& shape, const LinearSweep& sweep) {
  if (sweep.scale.x != sweep.scale.y) return std::nullopt;
  std::vector<RoundPoint> ends;
  for (const FlatDisk& d : disks_of_convex(shape)) {
    ends.push_back({{d.center.x, d.center.y, sweep.low}, d.radius});
    ends.push_back({{sweep.scale.x * d.center.x, sweep.scale.x * d.center.y, sweep.high},
                    sweep.scale.x * d.radius});
  }
  if (ends.empty()) return std::nullopt;
  bool is_too_large = false;
  auto solid = round_solid(RoundKind::kDiscs, std::move(ends), is_too_large);
  if (!solid) return std::nullopt;
  return std::move(solid->node);
}

/// The meshes as a union; nothing, with a warning, where the outlines cross one another.
std::optional<CsgNode> united(const std::optional<std::vector<PolygonMesh>>& meshes,
                              const ScadModule& module, ScadImport& import) {
  if (!meshes) {
    import.report.warning(module.line,
                          module.name + "() is left out: outlines of its figure cross");
    return std::nullopt;
  }
  std::vector<CsgNode> parts;
  for (const PolygonMesh& mesh : *meshes) {
    if (auto part = mesh_leaf(mesh, module, import.report)) parts.push_back(std::move(*part));
  }
  if (parts.empty()) return std::nullopt;
  return operation(Operation::kUnion, std::move(parts));
}

/// False, after reporting, for a mesh of too many facets.
bool is_mesh_small(const FlatLoops& loops, int rings, const ScadModule& module,
                   ScadImport& import) {
  std::size_t corners = 0;
  for (const FlatLoop& loop : loops) corners += loop.size();
  if (2 * corners * static_cast<std::size_t>(rings + 2) <= kMaxOpenscadFacets) return true;
  import.leave_out_once(module.name + "() facets", module.line,
                        module.name + "() is left out: it has more than " +
                            std::to_string(kMaxOpenscadFacets) + " facets");
  return false;
}

std::optional<CsgNode> upright(const LinearSweep& sweep, const ScadModule& module,
                               ScadImport& import, bool facets) {
  const auto shape = figure_of(module, import);
  if (!shape) return std::nullopt;
  if (sweep.is_straight()) return extruded(*shape, sweep.low, sweep.high, import, module.line);
  auto cone = sweep.twist == 0 && shape->has_curves() ? tapered(*shape, sweep) : std::nullopt;
  if (cone && !facets) return cone;
  if (!cone && shape->has_curves())
    import.warn_once(module.line,
                     "linear_extrude() with twist or scale takes circles by OpenSCAD's sides");
  const auto loops = polygon_of(*shape, import, module.line);
  if (!loops || !is_mesh_small(*loops, slices_of(*loops, sweep), module, import))
    return std::nullopt;
  return united(swept(*loops, sweep), module, import);
}

std::optional<CsgNode> linear(const ScadModule& module, ScadImport& import, bool facets) {
  const auto sweep = linear_sweep(module, import);
  auto solid = sweep ? upright(*sweep, module, import, facets) : std::nullopt;
  if (!solid || sweep->lean == FlatPoint{}) return solid;
  const Affine lean = leaning(*sweep);
  solid->transform = solid->transform ? compose(lean, *solid->transform) : lean;
  if (!solid->transform->inverse()) {
    import.report.warning(module.line, "linear_extrude() is left out: it leans too far to be seen");
    return std::nullopt;
  }
  return solid;
}

std::optional<CsgNode> rotated(const ScadModule& module, ScadImport& import, bool facets) {
  auto shape = figure_of(module, import);
  const auto loops = shape ? polygon_of(*shape, import, module.line) : std::nullopt;
  const auto sweep = loops ? turn_sweep(module, import, *loops) : std::nullopt;
  if (!sweep) return std::nullopt;
  // If few sides were asked for, they are intended.
  if (facets || asked_sides(sweep->fineness) > 0) {
    if (!is_mesh_small(*loops, steps_of(*loops, *sweep), module, import)) return std::nullopt;
    return united(turned_mesh(*loops, *sweep), module, import);
  }
  if (sweep->mirrored) {
    const FlatMap mirror{{{{-1, 0, 0}, {0, 1, 0}}}};
    shape = flat_union(module.children, mirror, import, module.line);
    if (!shape) return std::nullopt;
  }
  auto solid = turned_shape(*shape, import, module.line);
  if (!solid || sweep->angle == 360) return solid;
  const double start = sweep->start + (sweep->mirrored ? 180 : 0);
  std::vector<CsgNode> both;
  both.push_back(std::move(*solid));
  both.push_back(wedge(start + std::min(sweep->angle, 0.0), start + std::max(sweep->angle, 0.0)));
  return operation(Operation::kIntersection, std::move(both));
}

}  // namespace

std::optional<CsgNode> extruded(const FlatShape& shape, double low, double high, ScadImport& import,
                                int line) {
  if (shape.kind == Kind::kPolygon) return extruded_polygon(shape.loops, low, high, import, line);
  if (shape.kind == Kind::kDisk) return extruded_disk(shape.disk, low, high);
  const double margin = shape.kind == Kind::kUnion ? 0 : kReachBeyond * (high - low);
  return operated(shape, [&](const FlatShape& child, bool is_first) {
    const double more = is_first ? 0 : margin;
    return extruded(child, low - more, high + more, import, line);
  });
}

std::optional<CsgNode> mesh_leaf(const PolygonMesh& mesh, const ScadModule& module,
                                 OpenscadReport& report) {
  if (mesh.face_ends.empty()) return std::nullopt;
  auto closed = closed_mesh(mesh, kOpenscadGrid);
  if (auto* fault = std::get_if<MeshFault>(&closed)) {
    report.leave_out(module.name + "() not closed", module.line,
                     module.name + "() is left out: its faces enclose no solid: " + fault->why);
    return std::nullopt;
  }
  return leaf(MeshShape{std::get<TriangleMesh>(std::move(closed)), mesh.digits});
}

std::optional<CsgNode> openscad_sweep(const ScadModule& module, ScadImport& import) {
  return module.name == "linear_extrude" ? linear(module, import, false)
                                         : rotated(module, import, import.options.facets);
}

std::optional<CsgNode> faceted_sweep(const ScadModule& module, ScadImport& import) {
  return module.name == "linear_extrude" ? linear(module, import, true)
                                         : rotated(module, import, true);
}

bool plain_sweep(const ScadModule& module, ScadImport& import, std::optional<PlainSweep>& sweep) {
  const auto along = linear_sweep(module, import);
  if (along && (along->twist != 0 || !(along->lean == FlatPoint{}))) return false;
  auto shape = along ? figure_of(module, import) : std::nullopt;
  if (shape) sweep = PlainSweep{*std::move(shape), along->low, along->high, along->scale};
  return true;
}

bool is_exact_taper(const PlainSweep& sweep) { return !disks_of_convex(sweep.shape).empty(); }

std::optional<RoundTurn> round_turn(const ScadModule& module, ScadImport& import) {
  auto shape = figure_of(module, import);
  const auto loops = shape ? polygon_of(*shape, import, module.line) : std::nullopt;
  const auto sweep = loops ? turn_sweep(module, import, *loops) : std::nullopt;
  if (!sweep || import.options.facets || asked_sides(sweep->fineness) > 0) return std::nullopt;
  return RoundTurn{*std::move(shape), sweep->start, sweep->angle, steps_of(*loops, *sweep)};
}

std::optional<CsgNode> solid_of_profile(const std::vector<FlatDisk>& profile, ScadImport& import,
                                        int line) {
  ExactFlat hull = hull_of_disks(profile);
  if (!hull.shape) return std::nullopt;
  FlatShape& shape = *hull.shape;
  const auto is_mirror_image = [](const FlatShape& s) {
    return s.kind == Kind::kDisk && center_of(s.disk).x < 0;
  };
  std::erase_if(shape.children, is_mirror_image);
  if (!has_turned_form(shape)) return std::nullopt;
  return turned_shape(shape, import, line);
}

bool sweep_corners(const ScadModule& module, ScadImport& import, std::vector<Vec3>& corners) {
  const bool is_linear = module.name == "linear_extrude";
  const auto along = is_linear ? linear_sweep(module, import) : std::nullopt;
  if (is_linear && !along) return false;
  const auto shape = figure_of(module, import);
  const auto loops = shape ? polygon_of(*shape, import, module.line) : std::nullopt;
  if (!loops) return false;
  std::optional<std::vector<PolygonMesh>> meshes;
  if (along) {
    if (!is_mesh_small(*loops, slices_of(*loops, *along), module, import)) return false;
    meshes = swept(*loops, *along);
  } else if (const auto around = turn_sweep(module, import, *loops)) {
    if (!is_mesh_small(*loops, steps_of(*loops, *around), module, import)) return false;
    meshes = turned_mesh(*loops, *around);
  }
  if (!meshes) return false;
  const Affine lean = along ? leaning(*along) : Affine{};
  for (const PolygonMesh& mesh : *meshes) {
    for (const Vec3& p : mesh.points) corners.push_back(lean.point(p));
  }
  return true;
}

}  // namespace graycube
