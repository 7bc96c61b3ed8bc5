#include "formats/openscad/round_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "formats/openscad/flat/rounds.hpp"
#include "formats/openscad/flat/similarity.hpp"
#include "formats/openscad/language/matrix.hpp"
#include "formats/openscad/primitives.hpp"
#include "formats/openscad/sweep.hpp"

namespace graycube {
namespace {

using Kind = RoundItem::Kind;

bool is_container(const std::string& name) {
  return name == "group" || name == "union" || name == "color" || name == "render";
}

Affine linear_part(Affine map) {
  for (auto& row : map.m) row[3] = 0;
  return map;
}

/// `map` as seen from a frame without translation. If its linear part is the frame's, only a
/// translation is left, exactly.
Affine seen_from(const Affine& frame, const Affine& inverse, const Affine& map) {
  if (frame == Affine{}) return map;
  if (linear_part(map) == frame) return translation(inverse.vector(map.translation()));
  return compose(inverse, map);
}

std::optional<RoundPoint> framed_item(const RoundItem& item, const Affine& map) {
  const Vec3 center = map.point(item.round.center);
  if (item.kind == Kind::kPoint) return RoundPoint{center, 0};
  if (item.kind == Kind::kBall) {
    const auto scale = map.similarity_scale();
    if (!scale) return std::nullopt;
    return RoundPoint{center, *scale * item.round.radius};
  }
  const FlatMap level{{{{map.m[0][0], map.m[0][1], 0}, {map.m[1][0], map.m[1][1], 0}}}};
  const auto scale = similarity_scale(level);
  if (!scale ||
      std::max(std::fabs(map.m[2][0]), std::fabs(map.m[2][1])) > kRotationPrecision * *scale)
    return std::nullopt;
  return RoundPoint{center, *scale * item.round.radius};
}

/// Whether squares and products of its numbers can be told from 0 and infinity.
bool is_sensible(const RoundPoint& p) {
  return max_abs(p.center) <= kMaxOpenscadCoordinate && p.radius <= kMaxOpenscadCoordinate &&
         (p.radius == 0 || p.radius >= 1 / kMaxOpenscadCoordinate);
}

std::optional<FramedPiece> framed_by(const RoundPiece& items, const Affine& frame) {
  const auto inverse = frame.inverse();
  if (!inverse) return std::nullopt;
  FramedPiece result{frame, {}, false, false};
  for (const RoundItem& item : items) {
    const auto point = framed_item(item, seen_from(frame, *inverse, item.map));
    if (!point || !is_sensible(*point)) return std::nullopt;
    result.points.push_back(*point);
    result.has_balls = result.has_balls || item.kind == Kind::kBall;
    result.has_discs = result.has_discs || item.kind == Kind::kDisc;
  }
  return result;
}

RoundItem disc(const Vec3& center, double radius, const Affine& map) {
  return {radius > 0 ? Kind::kDisc : Kind::kPoint, {center, radius}, map};
}

bool add_primitive(const ScadModule& module, const Affine& map, PieceUse use, ScadImport& import,
                   std::vector<RoundPiece>& pieces) {
  RoundPiece piece;
  if (use == PieceUse::kHull && module.name == "polyhedron") {
    for (const Vec3& corner : polyhedron_corners(module, import.report))
      piece.push_back({Kind::kPoint, {corner, 0}, map});
    if (!piece.empty()) pieces.push_back(std::move(piece));
    return true;
  }
  const auto solid =
      openscad_primitive(module, import.report, import.options.facets, import.digits);
  if (!solid) return true;
  if (const auto* sphere = std::get_if<SphereShape>(&solid->leaf.value)) {
    piece.push_back({Kind::kBall, {sphere->center, sphere->radius}, map});
  } else if (const auto* cylinder = std::get_if<CylinderShape>(&solid->leaf.value)) {
    piece = {disc(cylinder->base, cylinder->radius, map),
             disc(cylinder->top, cylinder->radius, map)};
  } else if (const auto* cone = std::get_if<ConeShape>(&solid->leaf.value)) {
    piece = {disc(cone->base, cone->base_radius, map), disc(cone->top, cone->top_radius, map)};
  } else {
    if (use == PieceUse::kConvex && std::holds_alternative<MeshShape>(solid->leaf.value))
      return false;
    for (const Vec3& corner : solid->corners) piece.push_back({Kind::kPoint, {corner, 0}, map});
  }
  pieces.push_back(std::move(piece));
  return true;
}

bool add_plain_sweep(const PlainSweep& sweep, const FlatShape& shape, const Affine& map,
                     PieceUse use, std::vector<RoundPiece>& pieces) {
  std::vector<FlatDisk> disks = disks_of_convex(shape);
  if (disks.empty() && use == PieceUse::kHull && !add_hull_disks(shape, {}, disks)) return false;
  if (disks.empty() && shape.kind == FlatShape::Kind::kUnion) {
    return std::all_of(shape.children.begin(), shape.children.end(), [&](const FlatShape& child) {
      return add_plain_sweep(sweep, child, map, use, pieces);
    });
  }
  if (disks.empty()) return false;
  RoundPiece piece;
  for (const FlatDisk& d : disks) {
    if (d.radius > 0 && sweep.scale.x != sweep.scale.y) return false;
    const Vec3 top{sweep.scale.x * d.center.x, sweep.scale.y * d.center.y, sweep.high};
    piece.push_back(disc({d.center.x, d.center.y, sweep.low}, d.radius, map));
    piece.push_back(disc(top, sweep.scale.x * d.radius, map));
  }
  pieces.push_back(std::move(piece));
  return true;
}

/// Adds the hull of a figure turned about the axis, in which the figure's corners become discs.
bool add_turned(const FlatShape& figure, const Affine& map, std::vector<RoundPiece>& pieces) {
  std::vector<FlatDisk> disks;
  if (!add_hull_disks(figure, {}, disks)) return false;
  RoundPiece piece;
  for (const FlatDisk& d : disks) {
    if (d.radius > 0 && d.center.x != 0) return false;
    const Vec3 center{0, 0, d.center.y};
    piece.push_back(d.radius > 0 ? RoundItem{Kind::kBall, {center, d.radius}, map}
                                 : disc(center, std::fabs(d.center.x), map));
  }
  pieces.push_back(std::move(piece));
  return true;
}

bool add_all(std::span<const ScadModule> modules, const Affine& map, PieceUse use,
             ScadImport& import, std::vector<RoundPiece>& pieces) {
  return std::all_of(modules.begin(), modules.end(), [&](const ScadModule& module) {
    return module.left_out || module.dimension == 2 || add_pieces(module, map, use, import, pieces);
  });
}

/// Adds the hull of everything in the modules, as one piece. They are the file's own, not copies:
/// figures are kept by modules' addresses.
bool add_hull(std::span<const ScadModule> modules, const Affine& map, ScadImport& import,
              std::vector<RoundPiece>& pieces) {
  std::vector<RoundPiece> parts;
  if (!add_all(modules, map, PieceUse::kHull, import, parts)) return false;
  RoundPiece whole;
  for (const RoundPiece& part : parts) whole.insert(whole.end(), part.begin(), part.end());
  if (!whole.empty()) pieces.push_back(std::move(whole));
  return true;
}

/// Adds a sum: sums distribute over unions, and the hull of a sum is the sum of the hulls.
bool add_sum(const ScadModule& module, const Affine& map, PieceUse use, ScadImport& import,
             std::vector<RoundPiece>& pieces) {
  std::vector<RoundPiece> sums;
  bool is_first = true;
  for (const ScadModule& child : module.children) {
    if (child.left_out || child.dimension == 2) continue;
    std::vector<RoundPiece> operand;
    const bool is_known = use == PieceUse::kHull ? add_hull({&child, 1}, {}, import, operand)
                                                 : add_pieces(child, {}, use, import, operand);
    if (!is_known || operand.empty()) return false;
    if (std::exchange(is_first, false)) {
      sums = std::move(operand);
      continue;
    }
    if (sums.size() * operand.size() > kMaxSumPieces) return false;
    std::vector<RoundPiece> next;
    for (const RoundPiece& a : sums) {
      for (const RoundPiece& b : operand) {
        auto sum = sum_of(a, b);
        if (!sum) return false;
        next.push_back(*std::move(sum));
      }
    }
    sums = std::move(next);
  }
  for (RoundPiece& piece : sums) {
    for (RoundItem& item : piece) item.map = compose(map, item.map);
    pieces.push_back(std::move(piece));
  }
  return true;
}

}  // namespace

bool add_pieces(const ScadModule& module, const Affine& map, PieceUse use, ScadImport& import,
                std::vector<RoundPiece>& pieces) {
  if (is_container(module.name)) return add_all(module.children, map, use, import, pieces);
  if (module.name == "multmatrix") {
    const auto inner = openscad_matrix_of_corners(module, import.digits, import.report);
    if (!inner) return true;
    // What is flattened counts in hulls only.
    if (use == PieceUse::kConvex && !inner->inverse()) return false;
    return add_all(module.children, compose(map, *inner), use, import, pieces);
  }
  if (module.name == "hull") return add_hull(module.children, map, import, pieces);
  if (module.name == "minkowski") return add_sum(module, map, use, import, pieces);
  if (module.name == "linear_extrude") {
    std::optional<PlainSweep> sweep;
    if (!plain_sweep(module, import, sweep)) return false;
    return !sweep || add_plain_sweep(*sweep, sweep->shape, map, use, pieces);
  }
  if (module.name == "rotate_extrude" && use == PieceUse::kHull) {
    const auto turn = round_turn(module, import);
    return turn && turn->angle == 360 && add_turned(turn->shape, map, pieces);
  }
  return is_openscad_primitive(module) && add_primitive(module, map, use, import, pieces);
}

std::optional<FramedPiece> framed(const RoundPiece& items) {
  if (auto result = framed_by(items, {})) return result;
  const auto round = std::find_if(items.begin(), items.end(),
                                  [](const RoundItem& i) { return i.kind != Kind::kPoint; });
  return framed_by(items, linear_part(round->map));
}

std::optional<RoundPiece> sum_of(const RoundPiece& a, const RoundPiece& b) {
  if (a.size() * b.size() > kMaxSumItems) return std::nullopt;
  RoundPiece both = a;
  both.insert(both.end(), b.begin(), b.end());
  const auto all = framed(both);
  if (!all || (all->has_balls && all->has_discs)) return std::nullopt;
  const Kind round = all->has_balls ? Kind::kBall : Kind::kDisc;
  std::vector<RoundPoint> sums;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = a.size(); j < both.size(); ++j) {
      const RoundPoint &p = all->points[i], &q = all->points[j];
      sums.push_back({p.center + q.center, p.radius + q.radius});
    }
  }
  RoundPiece result;
  for (const RoundPoint& p :
       without_hidden(all->has_balls ? RoundKind::kBalls : RoundKind::kDiscs, std::move(sums))) {
    result.push_back({p.radius > 0 ? round : Kind::kPoint, p, all->frame});
  }
  return result;
}

}  // namespace graycube
