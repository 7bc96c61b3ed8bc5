#include "scene/flat_solids.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flat/pieces.hpp"
#include "geometry/infinity.hpp"

namespace graycube {
namespace {

/// How far a subtracted piece reaches beyond its own corners, as a share of its
/// height.
constexpr double kReachBeyond = 0.25;

/// Sides that are all but level make cones no wider than this, which is within kMaxCoordinate.
constexpr double kWidestCone = 1e17;

CsgNode leaf(decltype(CsgNode::value) value) {
  return {std::move(value), std::nullopt, kInheritMaterial};
}

CsgNode operation(Operation kind, std::vector<CsgNode> children) {
  if (children.size() == 1) return std::move(children.front());
  return leaf(OperationNode{kind, std::move(children)});
}

/// The solid of a piece less those of its `less` pieces. `solid_of(piece, level)` gives the solid
/// of the convex part, or nothing if that is empty.
template <typename SolidOf>
std::optional<CsgNode> solid_of_piece(const FlatPiece& piece, int level, const SolidOf& solid_of) {
  std::optional<CsgNode> whole = solid_of(piece, level);
  if (!whole) return std::nullopt;
  std::vector<CsgNode> children;
  children.push_back(std::move(*whole));
  for (const FlatPiece& inner : piece.less) {
    if (auto node = solid_of_piece(inner, level + 1, solid_of))
      children.push_back(std::move(*node));
  }
  return operation(Operation::kDifference, std::move(children));
}

template <typename SolidOf>
std::optional<CsgNode> solid_of_loops(const FlatLoops& loops, const SolidOf& solid_of) {
  const auto pieces = flat_pieces(loops);
  if (!pieces) return std::nullopt;
  std::vector<CsgNode> parts;
  for (const FlatPiece& piece : *pieces) {
    if (auto node = solid_of_piece(piece, 0, solid_of)) parts.push_back(std::move(*node));
  }
  if (parts.empty()) return std::nullopt;
  return operation(Operation::kUnion, std::move(parts));
}

CsgNode convex_prism(const std::vector<FlatEdge>& edges, double low, double high) {
  const auto along_axis = [](const FlatEdge& e) { return e.normal.x == 0 || e.normal.y == 0; };
  if (edges.size() == 4 && std::all_of(edges.begin(), edges.end(), along_axis)) {
    BoxShape box{{0, 0, low}, {0, 0, high}};
    for (const FlatEdge& e : edges) {
      if (e.normal.x != 0) (e.normal.x > 0 ? box.max.x : box.min.x) = e.normal.x * e.offset;
      if (e.normal.y != 0) (e.normal.y > 0 ? box.max.y : box.min.y) = e.normal.y * e.offset;
    }
    return leaf(box);
  }
  PolyhedronShape solid{{{{0, 0, -1}, -low}, {{0, 0, 1}, high}}};
  for (const FlatEdge& e : edges) solid.planes.push_back({{e.normal.x, e.normal.y, 0}, e.offset});
  return leaf(std::move(solid));
}

/// A convex polygon turned about the axis. Each side makes a cone about it: its inside for a side
/// that looks away from the axis, its outside for one that looks towards it.
class TurnedPiece {
 public:
  TurnedPiece(const FlatPiece& piece, int level) : piece_(piece) {
    low_ = kInf;
    high_ = -low_;
    for (const FlatPoint& p : piece.corners) {
      low_ = std::min(low_, p.y);
      high_ = std::max(high_, p.y);
    }
    margin_ = kReachBeyond * (high_ - low_);
    if (level > 0) {
      // Subtracted pieces may end anywhere beyond their corners, except at a side that is level.
      low_ -= margin_;
      high_ += margin_;
    }
    for (const FlatEdge& e : piece.edges) {
      if (e.normal.x != 0) continue;
      if (e.normal.y > 0) high_ = e.offset;
      if (e.normal.y < 0) low_ = -e.offset;
    }
  }

  std::optional<CsgNode> solid() const {
    std::vector<CsgNode> within, beyond;
    for (const FlatEdge& e : piece_.edges) {
      if (e.normal.x > 0) {
        auto cone = cone_of(e, low_, high_);
        if (!cone) return std::nullopt;
        within.push_back(std::move(*cone));
      } else if (e.normal.x < 0) {
        if (auto cone = cone_of(e, low_ - margin_, high_ + margin_))
          beyond.push_back(std::move(*cone));
      }
    }
    std::vector<CsgNode> all;
    all.push_back(operation(Operation::kIntersection, std::move(within)));
    for (CsgNode& cone : beyond) all.push_back(std::move(cone));
    return operation(Operation::kDifference, std::move(all));
  }

 private:
  /// The points between two heights that are nearer to the axis than the side's line; nothing if
  /// there are none.
  static std::optional<CsgNode> cone_of(const FlatEdge& e, double low, double high) {
    if (!(low < high)) return std::nullopt;
    if (e.normal.y == 0) {
      const double radius = e.offset / e.normal.x;
      if (!(radius > 0)) return std::nullopt;
      return leaf(CylinderShape{{0, 0, low}, {0, 0, high}, radius});
    }
    const auto radius_at = [&](double z) {
      return std::min((e.offset - e.normal.y * z) / e.normal.x, kWidestCone);
    };
    double r_low = radius_at(low), r_high = radius_at(high);
    if (!(r_low > 0) && !(r_high > 0)) return std::nullopt;
    const double apex = e.offset / e.normal.y;
    if (r_low < 0) low = apex, r_low = 0;
    if (r_high < 0) high = apex, r_high = 0;
    if (!(low < high)) return std::nullopt;
    return leaf(ConeShape{{0, 0, low}, r_low, {0, 0, high}, r_high});
  }

  const FlatPiece& piece_;
  double low_ = 0, high_ = 0, margin_ = 0;
};

}  // namespace

std::optional<CsgNode> prism_of(const FlatLoops& loops, double low, double high) {
  return solid_of_loops(loops, [&](const FlatPiece& piece, int level) -> std::optional<CsgNode> {
    const double margin = kReachBeyond * level * (high - low);
    return convex_prism(piece.edges, low - margin, high + margin);
  });
}

FlatLoops loops_of(const PrismShape& shape) {
  if (shape.paths.empty()) return {shape.points};
  FlatLoops loops;
  for (const auto& path : shape.paths) {
    FlatLoop loop;
    for (const std::uint32_t corner : path) loop.push_back(shape.points[corner]);
    loops.push_back(std::move(loop));
  }
  return loops;
}

std::optional<CsgNode> prism_of(const PrismShape& shape) {
  return prism_of(loops_of(shape), shape.base, shape.base + shape.height);
}

PrismShape prism_shape(const FlatLoops& loops, double low, double high) {
  PrismShape shape;
  shape.base = low;
  shape.height = high - low;
  for (const FlatLoop& loop : loops) {
    std::vector<std::uint32_t> path;
    for (const FlatPoint& p : loop) {
      path.push_back(static_cast<std::uint32_t>(shape.points.size()));
      shape.points.push_back(p);
    }
    shape.paths.push_back(std::move(path));
  }
  if (shape.paths.size() == 1) shape.paths.clear();
  return shape;
}

std::optional<CsgNode> turned(const FlatLoops& loops) {
  double reach = 0, lowest = kInf, highest = -lowest;
  bool crosses_axis = false;
  for (const FlatLoop& loop : loops) {
    for (const FlatPoint& p : loop) {
      reach = std::max(reach, std::fabs(p.x));
      lowest = std::min(lowest, p.y);
      highest = std::max(highest, p.y);
      crosses_axis = crosses_axis || p.x < 0;
    }
  }
  FlatLoops right = loops;
  if (crosses_axis) {
    const FlatLoops half{{{0, lowest}, {reach, lowest}, {reach, highest}, {0, highest}}};
    const FlatLoops both[] = {loops, half};
    right = combined(FlatOperation::kIntersection, both);
  }
  return solid_of_loops(
      right, [](const FlatPiece& piece, int level) { return TurnedPiece(piece, level).solid(); });
}

}  // namespace graycube
