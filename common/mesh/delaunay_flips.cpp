#include "mesh/delaunay_flips.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace graycube {
namespace {

/// The cosine and sine of the angle, 0.01, by which the two angles that face a side may be more
/// than 180° together: libtess2, by which OpenSCAD cuts faces, lets the side stay as long (geom.c).
constexpr double kCosine = 0.99995000041666528, kSine = 0.0099998333341666646;

/// The most flips, which only a bent face of more than 4096 corners can need: 10 s. What is left
/// then stays as it is.
constexpr std::size_t kMaxFlips = std::size_t{1} << 24;

/// The cosine and sine, times some length, of the angle at p between a and b.
FacePoint angle_at(const FacePoint& p, const FacePoint& a, const FacePoint& b) {
  return {(a.x - p.x) * (b.x - p.x) + (a.y - p.y) * (b.y - p.y), std::fabs(turn(p, a, b))};
}

/// Whether d lies within the circle through a, b, c, clearly: the angles at c and d over the side
/// from a to b are then more than 180° together.
bool is_in_circle(const FacePoint& a, const FacePoint& b, const FacePoint& c, const FacePoint& d) {
  const FacePoint g = angle_at(c, a, b), h = angle_at(d, a, b);
  if (g.x >= 0 && h.x >= 0) return false;
  const FacePoint both{g.x * h.x - g.y * h.y, g.x * h.y + g.y * h.x};
  return both.y * kCosine - both.x * kSine <= 0;
}

class Flips {
 public:
  Flips(std::span<const FacePoint> corners, std::span<Triangle> triangles)
      : corners_(corners), triangles_(triangles) {
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) note_sides(t);
  }

  void run() {
    std::vector<Side> open;
    for (const auto& [side, t] : triangle_at_) {
      if (side.first < side.second) open.push_back(side);
    }
    // Each flip lowers the triangulation; the limit is for rounding that would go in circles.
    const std::size_t n = triangles_.size();
    std::size_t left = std::min(n * n + n, kMaxFlips);
    while (!open.empty() && left-- > 0) {
      const Side side = open.back();
      open.pop_back();
      flip(side, open);
    }
  }

 private:
  using Side = std::pair<std::uint32_t, std::uint32_t>;

  void note_sides(std::uint32_t t) {
    const Triangle& c = triangles_[t];
    for (std::size_t i = 0; i < 3; ++i) triangle_at_[{c[i], c[(i + 1) % 3]}] = t;
  }
  static std::uint32_t opposite(const Triangle& t, const Side& side) {
    return t[0] != side.first && t[0] != side.second   ? t[0]
           : t[1] != side.first && t[1] != side.second ? t[1]
                                                       : t[2];
  }

  void flip(const Side& side, std::vector<Side>& open) {
    const auto [a, b] = side;
    const auto left = triangle_at_.find(side), right = triangle_at_.find({b, a});
    if (left == triangle_at_.end() || right == triangle_at_.end()) return;
    const std::uint32_t t = left->second, u = right->second;
    const std::uint32_t c = opposite(triangles_[t], side), d = opposite(triangles_[u], side);
    const FacePoint &pa = corners_[a], &pb = corners_[b], &pc = corners_[c], &pd = corners_[d];
    if (!(turn(pc, pa, pd) > 0) || !(turn(pd, pb, pc) > 0)) return;
    if (!is_in_circle(pa, pb, pc, pd)) return;
    triangle_at_.erase(left);
    triangle_at_.erase(right);
    triangles_[t] = {c, a, d};
    triangles_[u] = {d, b, c};
    note_sides(t);
    note_sides(u);
    for (const Side& outer : {Side{c, a}, Side{a, d}, Side{d, b}, Side{b, c}})
      open.push_back(outer);
  }

  std::span<const FacePoint> corners_;
  std::span<Triangle> triangles_;
  std::map<Side, std::uint32_t> triangle_at_;
};

}  // namespace

void flip_to_delaunay(std::span<const FacePoint> corners, std::span<Triangle> triangles) {
  Flips(corners, triangles).run();
}

}  // namespace graycube
