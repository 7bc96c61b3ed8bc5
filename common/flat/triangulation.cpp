#include "flat/triangulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <utility>

namespace graycube {
namespace {

constexpr std::uint32_t kNone = 0xFFFFFFFFu;
/// The triangle around all points lies so many extents away from them.
constexpr double kFarAway = 16;

/// Whether d lies clearly within the circle through a, b, c (counter-clockwise). Only the shape of
/// the triangles depends on it, so that rounding does no harm.
bool is_in_circle(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c, const FlatPoint& d) {
  const double ax = a.x - d.x, ay = a.y - d.y, bx = b.x - d.x, by = b.y - d.y;
  const double cx = c.x - d.x, cy = c.y - d.y;
  const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
  return a2 * (bx * cy - by * cx) - b2 * (ax * cy - ay * cx) + c2 * (ax * by - ay * bx) > 0;
}

/// A triangulation of points that grows point by point (Lawson 1977), into which sides are then
/// flipped (Sloan 1993).
class Triangulation {
 public:
  /// Points that are equal must have been made one.
  explicit Triangulation(std::vector<FlatPoint> points)
      : points_(std::move(points)), triangle_at_(points_.size() + 3, kNone) {
    const auto [lo, hi] = flat_bounds(std::span(&points_, 1));
    const double extent = std::max(hi.x - lo.x, hi.y - lo.y) * kFarAway;
    const FlatPoint c{0.5 * (lo.x + hi.x), 0.5 * (lo.y + hi.y)};
    const auto n = static_cast<std::uint32_t>(points_.size());
    points_.push_back({c.x - 2 * extent, c.y - extent});
    points_.push_back({c.x + 2 * extent, c.y - extent});
    points_.push_back({c.x, c.y + 2 * extent});
    put({{n, n + 1, n + 2}, {kNone, kNone, kNone}, {}}, 0);
  }

  bool insert(std::uint32_t point) {
    const auto found = triangle_with(point);
    if (!found) return false;
    const auto [t, edge] = *found;
    if (edge == 3) {
      split_triangle(t, point);
    } else {
      split_edge(t, edge, point);
    }
    return true;
  }

  /// Makes the line from a to b a side; false where it can't be one.
  bool force(std::uint32_t a, std::uint32_t b) {
    std::deque<Side> crossing;
    if (!collect_crossing(a, b, crossing)) return false;
    // Each flip makes one side fewer cross, or another quadrilateral convex.
    std::size_t tries = 8 * crossing.size() * crossing.size() + 8;
    while (!crossing.empty()) {
      if (tries-- == 0) return false;
      const Side side = crossing.front();
      crossing.pop_front();
      const auto made = flip(side);
      if (!made) {
        crossing.push_back(side);
      } else if (crosses(*made, a, b)) {
        crossing.push_back(*made);
      }
    }
    return mark(a, b);
  }

  /// The triangles that an odd number of forced sides separates from the outside.
  std::vector<FlatTriangle> within() const {
    std::vector<FlatTriangle> result;
    const auto outer = static_cast<std::uint32_t>(points_.size() - 3);
    std::vector<std::int8_t> depth(triangles_.size(), -1);
    std::vector<std::uint32_t> open{triangle_at_[outer]};
    depth[open.front()] = 0;
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back();
      if (depth[t] == 1) result.push_back(triangles_[t].corners);
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t next = triangles_[t].across[i];
        if (next == kNone || depth[next] >= 0) continue;
        depth[next] = static_cast<std::int8_t>(depth[t] ^ (triangles_[t].forced[i] & 1));
        open.push_back(next);
      }
    }
    return result;
  }

 private:
  /// Counter-clockwise; side i lies opposite to corner i, `forced` counts how often it was.
  struct Corners {
    FlatTriangle corners;
    std::array<std::uint32_t, 3> across;
    std::array<std::uint8_t, 3> forced;
  };
  using Side = std::pair<std::uint32_t, std::uint32_t>;
  struct Place {
    std::uint32_t triangle;
    std::size_t side;
  };

  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return orientation(points_[a], points_[b], points_[c]);
  }

  void put(const Corners& triangle, std::uint32_t at) {
    if (at == triangles_.size()) triangles_.emplace_back();
    triangles_[at] = triangle;
    for (const std::uint32_t corner : triangle.corners) triangle_at_[corner] = at;
  }
  std::uint32_t next_place() {
    triangles_.emplace_back();
    return static_cast<std::uint32_t>(triangles_.size() - 1);
  }
  void reconnect(std::uint32_t t, std::uint32_t before, std::uint32_t now) {
    if (t == kNone) return;
    for (std::uint32_t& across : triangles_[t].across) {
      if (across == before) across = now;
    }
  }
  std::size_t side_to(std::uint32_t t, std::uint32_t neighbour) const {
    const auto& across = triangles_[t].across;
    return across[0] == neighbour ? 0 : across[1] == neighbour ? 1 : 2;
  }

  /// Walks to the triangle that holds the point, and the side on which it lies, or 3.
  std::optional<Place> triangle_with(std::uint32_t point) {
    std::uint32_t t = last_;
    for (std::size_t steps = 0; steps <= 4 * triangles_.size() + 16; ++steps) {
      const FlatTriangle& c = triangles_[t].corners;
      std::size_t on = 3, beyond = 3;
      for (std::size_t k = 0; k < 3 && beyond == 3; ++k) {
        const std::size_t i = (k + steps) % 3;
        const int side = turn(c[(i + 1) % 3], c[(i + 2) % 3], point);
        if (side < 0) beyond = i;
        if (side == 0) on = i;
      }
      if (beyond == 3) return Place{t, on};
      t = triangles_[t].across[beyond];
      if (t == kNone) return std::nullopt;
    }
    return std::nullopt;
  }

  void split_triangle(std::uint32_t t, std::uint32_t p) {
    const Corners old = triangles_[t];
    const std::array<std::uint32_t, 3> at{t, next_place(), next_place()};
    for (std::size_t i = 0; i < 3; ++i) {
      // The new triangle at the old one's side i.
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      put({{p, old.corners[j], old.corners[k]}, {old.across[i], at[j], at[k]}, {}}, at[i]);
      reconnect(old.across[i], t, at[i]);
    }
    last_ = t;
    for (const std::uint32_t part : at) settle(part);
  }

  void split_edge(std::uint32_t t, std::size_t side, std::uint32_t p) {
    const std::uint32_t u = triangles_[t].across[side];
    if (u == kNone) return split_triangle(t, p);
    const Corners a = triangles_[t], b = triangles_[u];
    const std::size_t other = side_to(u, t);
    const std::uint32_t v = next_place(), w = next_place();
    const std::size_t a1 = (side + 1) % 3, a2 = (side + 2) % 3;
    const std::size_t b1 = (other + 1) % 3, b2 = (other + 2) % 3;
    // The corners of the side are a1 and a2 in t, b2 and b1 in u.
    put({{p, a.corners[a2], a.corners[side]}, {a.across[a1], v, u}, {}}, t);
    put({{p, a.corners[side], a.corners[a1]}, {a.across[a2], w, t}, {}}, v);
    put({{p, b.corners[other], b.corners[b1]}, {b.across[b2], t, w}, {}}, u);
    put({{p, b.corners[b2], b.corners[other]}, {b.across[b1], u, v}, {}}, w);
    reconnect(a.across[a2], t, v);
    reconnect(b.across[b1], u, w);
    last_ = t;
    for (const std::uint32_t part : {t, v, u, w}) settle(part);
  }

  /// Flips the side opposite to the new point, corner 0, while a circle isn't empty.
  void settle(std::uint32_t first) {
    std::vector<std::uint32_t> open{first};
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back();
      const std::uint32_t u = triangles_[t].across[0];
      if (u == kNone) continue;
      const FlatTriangle& c = triangles_[t].corners;
      const std::uint32_t opposite = triangles_[u].corners[side_to(u, t)];
      if (!is_in_circle(points_[c[0]], points_[c[1]], points_[c[2]], points_[opposite])) continue;
      if (!flip_at(t, 0)) continue;
      open.push_back(t);
      open.push_back(u);
    }
  }

  /// Turns the diagonal of the two triangles at a side; false if they aren't strictly convex.
  /// Both keep corner `side` of t as their corner 0.
  bool flip_at(std::uint32_t t, std::size_t side) {
    const std::uint32_t u = triangles_[t].across[side];
    const Corners a = triangles_[t], b = triangles_[u];
    const std::size_t other = side_to(u, t);
    const std::size_t a1 = (side + 1) % 3, a2 = (side + 2) % 3;
    const std::size_t b1 = (other + 1) % 3, b2 = (other + 2) % 3;
    const std::uint32_t p = a.corners[side], q = b.corners[other];
    if (turn(p, a.corners[a1], q) <= 0 || turn(p, q, a.corners[a2]) <= 0) return false;
    put({{p, a.corners[a1], q}, {b.across[b1], u, a.across[a2]}, {b.forced[b1], 0, a.forced[a2]}},
        t);
    put({{p, q, a.corners[a2]}, {b.across[b2], a.across[a1], t}, {b.forced[b2], a.forced[a1], 0}},
        u);
    reconnect(b.across[b1], u, t);
    reconnect(a.across[a1], t, u);
    return true;
  }

  /// The side between two corners, in the triangle that has it from a to b.
  std::optional<Place> side_of(std::uint32_t a, std::uint32_t b) const {
    std::uint32_t t = triangle_at_[a];
    const std::uint32_t first = t;
    do {
      const FlatTriangle& c = triangles_[t].corners;
      const std::size_t i = c[0] == a ? 0 : c[1] == a ? 1 : 2;
      if (c[(i + 1) % 3] == b) return Place{t, (i + 2) % 3};
      t = triangles_[t].across[(i + 1) % 3];
    } while (t != first && t != kNone);
    return std::nullopt;
  }

  /// The side that the flip makes; nothing if it can't be done now.
  std::optional<Side> flip(const Side& side) {
    // About a corner of the outermost triangle not all triangles are found.
    auto place = side_of(side.first, side.second);
    if (!place) place = side_of(side.second, side.first);
    if (!place) return std::nullopt;
    const auto [t, i] = *place;
    const std::uint32_t u = triangles_[t].across[i];
    const Side made{triangles_[t].corners[i], triangles_[u].corners[side_to(u, t)]};
    if (!flip_at(t, i)) return std::nullopt;
    return made;
  }

  bool crosses(const Side& side, std::uint32_t a, std::uint32_t b) const {
    const auto [p, q] = side;
    if (p == a || p == b || q == a || q == b) return false;
    return turn(a, b, p) * turn(a, b, q) < 0 && turn(p, q, a) * turn(p, q, b) < 0;
  }

  /// The sides that the line from a to b crosses; false if it meets a corner or a forced side.
  bool collect_crossing(std::uint32_t a, std::uint32_t b, std::deque<Side>& crossing) const {
    if (side_of(a, b)) return true;
    std::uint32_t t = triangle_at_[a];
    const std::uint32_t first = t;
    std::size_t i = 0;
    for (bool is_found = false; !is_found;) {
      const FlatTriangle& c = triangles_[t].corners;
      i = c[0] == a ? 0 : c[1] == a ? 1 : 2;
      is_found = turn(a, b, c[(i + 1) % 3]) < 0 && turn(a, b, c[(i + 2) % 3]) > 0;
      if (is_found) break;
      t = triangles_[t].across[(i + 1) % 3];
      if (t == first || t == kNone) return false;
    }
    while (true) {
      const Corners& here = triangles_[t];
      if (here.forced[i] != 0) return false;
      crossing.emplace_back(here.corners[(i + 1) % 3], here.corners[(i + 2) % 3]);
      const std::uint32_t u = here.across[i];
      if (u == kNone) return false;
      const std::size_t other = side_to(u, t);
      const std::uint32_t corner = triangles_[u].corners[other];
      if (corner == b) return true;
      const int side = turn(a, b, corner);
      if (side == 0) return false;
      // A corner on the left replaces that on the left: the line leaves between it and the right.
      i = side > 0 ? (other + 1) % 3 : (other + 2) % 3;
      t = u;
    }
  }

  bool mark(std::uint32_t a, std::uint32_t b) {
    const auto place = side_of(a, b);
    if (!place) return false;
    const auto [t, i] = *place;
    const std::uint32_t u = triangles_[t].across[i];
    const std::size_t other = side_to(u, t);
    // Twice is there and back: even, but forced all the same.
    std::uint8_t& count = triangles_[t].forced[i];
    count = count == 0 || count == 2 ? static_cast<std::uint8_t>(count + 1) : std::uint8_t{2};
    triangles_[u].forced[other] = count;
    return true;
  }

  std::vector<FlatPoint> points_;
  std::vector<std::uint32_t> triangle_at_;
  std::vector<Corners> triangles_;
  std::uint32_t last_ = 0;
};

/// Distinct points, the first corner with each, and the point of each corner.
struct DistinctPoints {
  std::vector<FlatPoint> points;
  std::vector<std::uint32_t> corner, point_of;
};

DistinctPoints distinct(std::span<const FlatLoop> loops) {
  FlatLoop all;
  for (const FlatLoop& loop : loops) all.insert(all.end(), loop.begin(), loop.end());
  std::vector<std::uint32_t> order(all.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const FlatPoint &p = all[a], &q = all[b];
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : a < b;
  });
  DistinctPoints result;
  result.point_of.resize(all.size());
  for (const std::uint32_t i : order) {
    if (result.points.empty() || !(result.points.back() == all[i])) {
      result.points.push_back(all[i]);
      result.corner.push_back(i);
    }
    result.point_of[i] = static_cast<std::uint32_t>(result.points.size() - 1);
  }
  return result;
}

/// The points strip by strip, to and fro, so that each is near the one before.
std::vector<std::uint32_t> strip_order(const std::vector<FlatPoint>& points) {
  std::vector<std::uint32_t> order(points.size());
  for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  // They come in the order of x.
  const auto strip = static_cast<std::size_t>(std::sqrt(static_cast<double>(points.size()))) + 1;
  bool is_upward = true;
  for (std::size_t begin = 0; begin < order.size(); begin += strip) {
    const auto from = order.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto to =
        order.begin() + static_cast<std::ptrdiff_t>(std::min(begin + strip, order.size()));
    std::stable_sort(from, to, [&](std::uint32_t a, std::uint32_t b) {
      return is_upward ? points[a].y < points[b].y : points[a].y > points[b].y;
    });
    is_upward = !is_upward;
  }
  return order;
}

}  // namespace

std::optional<std::vector<FlatTriangle>> triangles_of(std::span<const FlatLoop> loops) {
  const DistinctPoints all = distinct(loops);
  if (all.points.size() < 3) return std::nullopt;
  Triangulation net(all.points);
  for (const std::uint32_t point : strip_order(all.points)) {
    if (!net.insert(point)) return std::nullopt;
  }
  std::size_t begin = 0;
  for (const FlatLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = all.point_of[begin + i];
      const std::uint32_t b = all.point_of[begin + (i + 1) % loop.size()];
      if (a != b && !net.force(a, b)) return std::nullopt;
    }
    begin += loop.size();
  }
  std::vector<FlatTriangle> triangles = net.within();
  for (FlatTriangle& t : triangles) {
    for (std::uint32_t& corner : t) corner = all.corner[corner];
  }
  return triangles;
}

}  // namespace graycube
