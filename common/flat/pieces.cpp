#include "flat/pieces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace graycube {
namespace {

/// The most halvings of a part whose pockets nest too deep.
constexpr int kMaxCuts = 12;
/// How far a pocket reaches out of its opening, as a share of its own depth.
constexpr double kReachOut = 0.5;

double beyond(const FlatEdge& edge, const FlatPoint& p) {
  return edge.normal.x * p.x + edge.normal.y * p.y - edge.offset;
}

/// The positions of the hull's corners in a simple loop, ascending; nothing when they don't stand
/// in the loop's order, as they do in every simple one.
std::optional<std::vector<std::size_t>> hull_positions(const FlatLoop& loop) {
  std::vector<std::size_t> order(loop.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    if (loop[i].x != loop[j].x) return loop[i].x < loop[j].x;
    return loop[i].y != loop[j].y ? loop[i].y < loop[j].y : i < j;
  });
  const auto same = [&](std::size_t i, std::size_t j) { return loop[i] == loop[j]; };
  order.erase(std::unique(order.begin(), order.end(), same), order.end());
  std::vector<std::size_t> hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= start + 2 &&
             orientation(loop[hull[hull.size() - 2]], loop[hull.back()], loop[*p]) <= 0) {
        hull.pop_back();
      }
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  add_chain(order.begin(), order.end());
  add_chain(order.rbegin(), order.rend());
  if (hull.size() < 3) return std::nullopt;
  std::rotate(hull.begin(), std::min_element(hull.begin(), hull.end()), hull.end());
  if (!std::is_sorted(hull.begin(), hull.end())) return std::nullopt;
  return hull;
}

/// Cuts a polygon by a line: the corners on its inner side and where it crosses (Sutherland &
/// Hodgman 1974).
FlatLoop clipped(const FlatLoop& corners, const FlatEdge& edge) {
  FlatLoop kept;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const FlatPoint& a = corners[i];
    const FlatPoint& b = corners[(i + 1) % corners.size()];
    const double fa = beyond(edge, a), fb = beyond(edge, b);
    if (fa <= 0) kept.push_back(a);
    if ((fa < 0 && fb > 0) || (fa > 0 && fb < 0)) {
      const double s = fa / (fa - fb);
      kept.push_back({a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)});
    }
  }
  return kept;
}

/// The convex part with the side from its last corner to its first moved outwards by `distance`:
/// the quadrangle between the old side and the new one is cut by the two sides next to it.
FlatLoop reaching_out(FlatLoop corners, const std::vector<FlatEdge>& edges, double distance) {
  const FlatPoint first = corners.front(), last = corners.back();
  const FlatPoint n = edges.back().normal;
  const FlatPoint along{-n.y, n.x};  // from `last` to `first`
  // The neighbours widen by less than the whole piece is wide, since a piece is deep only where
  // they are steep.
  double extent = 0;
  for (const FlatPoint& p : corners) {
    extent = std::max(extent, std::fabs(along.x * (p.x - last.x) + along.y * (p.y - last.y)));
  }
  const double wide = 4 * (extent + distance);
  FlatLoop strip{
      {last.x - wide * along.x, last.y - wide * along.y},
      {last.x - wide * along.x + distance * n.x, last.y - wide * along.y + distance * n.y},
      {first.x + wide * along.x + distance * n.x, first.y + wide * along.y + distance * n.y},
      {first.x + wide * along.x, first.y + wide * along.y}};
  std::reverse(strip.begin(), strip.end());
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) strip = clipped(strip, edges[i]);
  corners.insert(corners.end(), strip.begin(), strip.end());
  return corners;
}

class Cutter {
 public:
  /// The piece of a simple counter-clockwise loop; if `is_pocket`, its last side is the opening.
  std::optional<FlatPiece> cut(const FlatLoop& loop, const FlatLoops& holes, bool is_pocket,
                               int level) {
    if (level > kMaxPieceLevels) {
      too_deep_ = true;
      return std::nullopt;
    }
    const auto hull = hull_positions(loop);
    if (!hull) return std::nullopt;
    FlatPiece piece;
    for (std::size_t i = 0; i < hull->size(); ++i) {
      const std::size_t from = (*hull)[i], to = (*hull)[(i + 1) % hull->size()];
      piece.corners.push_back(loop[from]);
      piece.edges.push_back(edge_between(loop[from], loop[to]));
      if (!add_pocket(loop, from, to, level, piece)) return std::nullopt;
    }
    if (is_pocket) open_out(piece);
    for (const FlatLoop& hole : holes) {
      FlatLoop turned(hole.rbegin(), hole.rend());
      auto inner = cut(turned, {}, false, level + 1);
      if (!inner) return std::nullopt;
      piece.less.push_back(std::move(*inner));
    }
    return piece;
  }
  bool too_deep() const { return too_deep_; }

 private:
  /// Adds the pocket between a side of the hull and the outline from one of its ends to the other.
  bool add_pocket(const FlatLoop& loop, std::size_t from, std::size_t to, int level,
                  FlatPiece& piece) {
    const std::size_t count = (to + loop.size() - from) % loop.size();
    if (count < 2) return true;
    FlatLoop pocket;
    bool is_flat = true;
    for (std::size_t k = 0; k <= count; ++k) {
      pocket.push_back(loop[(to + loop.size() - k) % loop.size()]);
      is_flat = is_flat && orientation(loop[from], loop[to], pocket.back()) == 0;
    }
    if (is_flat) return true;
    auto inner = cut(pocket, {}, true, level + 1);
    if (!inner) return false;
    piece.less.push_back(std::move(*inner));
    return true;
  }

  static void open_out(FlatPiece& piece) {
    FlatEdge& opening = piece.edges.back();
    double depth = 0;
    for (const FlatPoint& p : piece.corners) depth = std::max(depth, -beyond(opening, p));
    piece.corners = reaching_out(std::move(piece.corners), piece.edges, kReachOut * depth);
    opening.offset += kReachOut * depth;
  }

  bool too_deep_ = false;
};

bool add_pieces(const FlatRegion& region, int cuts, std::vector<FlatPiece>& pieces) {
  Cutter cutter;
  if (auto piece = cutter.cut(region.outline, region.holes, false, 1)) {
    pieces.push_back(std::move(*piece));
    return true;
  }
  if (!cutter.too_deep() || cuts == kMaxCuts) return false;
  FlatLoops whole = region.holes;
  whole.push_back(region.outline);
  const auto [lo, hi] = flat_bounds(whole);
  const double middle = 0.5 * (lo.x + hi.x);
  for (const auto& [left, right] : {std::pair{lo.x, middle}, std::pair{middle, hi.x}}) {
    const FlatLoops half{{{left, lo.y}, {right, lo.y}, {right, hi.y}, {left, hi.y}}};
    const FlatLoops both[] = {whole, half};
    for (const FlatRegion& part : regions_of(combined(FlatOperation::kIntersection, both))) {
      if (!add_pieces(part, cuts + 1, pieces)) return false;
    }
  }
  return true;
}

}  // namespace

FlatEdge edge_between(const FlatPoint& a, const FlatPoint& b) {
  const bool forwards = a.x != b.x ? a.x < b.x : a.y < b.y;
  const FlatPoint &from = forwards ? a : b, &to = forwards ? b : a;
  const double sign = forwards ? 1 : -1;
  if (from.x == to.x) return {{sign, 0}, sign * from.x};
  if (from.y == to.y) return {{0, -sign}, -sign * from.y};
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double l = std::sqrt(dx * dx + dy * dy);
  const FlatPoint n{sign * (dy / l), -sign * (dx / l)};
  return {n, n.x * from.x + n.y * from.y};
}

std::optional<std::vector<FlatPiece>> flat_pieces(const FlatLoops& loops) {
  std::vector<FlatPiece> pieces;
  for (const FlatRegion& region : regions_of(loops)) {
    if (!add_pieces(region, 0, pieces)) return std::nullopt;
  }
  return pieces;
}

}  // namespace graycube
