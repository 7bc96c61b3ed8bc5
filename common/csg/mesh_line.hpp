// Which triangles of a mesh a line passes through. The mesh is sheared so that the line becomes an axis (Woop, Benthin &
// Wald 2013); then the question is how often each triangle's outline winds around the origin of a plane. That is counted
// edge by edge: an edge of which exactly one end lies above the x axis counts where it cuts the axis' positive half,
// +1 upwards and −1 downwards. Since an edge seen the other way counts the negative, whatever was rounded before, the
// counts of all triangles of a closed mesh always add up to zero; and since the side on which the origin lies of an
// edge is found exactly, each triangle's count is −1, 0 or 1. Lines through vertices and along edges need no rule
// of their own: one triangle takes them, as if the line were moved by next to nothing.
#pragma once

#include <cmath>

#include "geometry/ray.hpp"

namespace graycube::csg {

/// A point as the line sees it: across the line, and its parameter along it.
struct LinePoint {
  double x, y, t;
};

class MeshLine {
 public:
  explicit MeshLine(const Ray& ray) : origin_(ray.origin) {
    const Vec3& d = ray.direction;
    for (int a = 1; a < 3; ++a) {
      if (std::fabs(d[a]) > std::fabs(d[along_])) along_ = a;
    }
    // Right-handed seen against the line: counterclockwise triangles are those whose outside faces its origin.
    const bool forward = d[along_] > 0;
    x_ = (along_ + (forward ? 2 : 1)) % 3;
    y_ = (along_ + (forward ? 1 : 2)) % 3;
    inverse_ = 1.0 / d[along_];
    slope_x_ = d[x_] * inverse_;
    slope_y_ = d[y_] * inverse_;
  }

  LinePoint see(const Vec3& p) const {
    const double ahead = p[along_] - origin_[along_];
    return {(p[x_] - origin_[x_]) - slope_x_ * ahead, (p[y_] - origin_[y_]) - slope_y_ * ahead, ahead * inverse_};
  }

 private:
  Vec3 origin_;
  int along_ = 0, x_ = 0, y_ = 0;
  double inverse_ = 0, slope_x_ = 0, slope_y_ = 0;
};

/// The sign of a.x b.y − a.y b.x, exact but for underflow. Rounded products that differ are in the order of the exact
/// ones; of equal ones the rounding errors decide, which a fused multiply-add gives exactly, on every machine.
inline int side_of_origin(const LinePoint& a, const LinePoint& b) {
  const double p = a.x * b.y, q = a.y * b.x;
  if (p != q) return p > q ? 1 : -1;
  const double p_rest = std::fma(a.x, b.y, -p), q_rest = std::fma(a.y, b.x, -q);
  return p_rest > q_rest ? 1 : p_rest < q_rest ? -1 : 0;
}

/// An edge's count: see above. count(a, b) = −count(b, a).
inline int edge_count(const LinePoint& a, const LinePoint& b) {
  const bool a_above = a.y >= 0, b_above = b.y >= 0;
  if (a_above == b_above) return 0;
  const int side = side_of_origin(a, b);
  if (b_above) return side > 0 ? 1 : 0;
  return side < 0 ? -1 : 0;
}

/// +1 where the line enters through the triangle's outside, −1 where it leaves through it, 0 where it passes by.
inline int triangle_count(const LinePoint& a, const LinePoint& b, const LinePoint& c) {
  const bool a_above = a.y >= 0, b_above = b.y >= 0;
  if (a_above == b_above && b_above == (c.y >= 0)) return 0;
  return edge_count(a, b) + edge_count(b, c) + edge_count(c, a);
}

/// Where the line meets the triangle that it passes through: the corners' parameters, weighted by where it does.
inline double parameter_within(const LinePoint& a, const LinePoint& b, const LinePoint& c) {
  const double u = b.x * c.y - b.y * c.x, v = c.x * a.y - c.y * a.x, w = a.x * b.y - a.y * b.x;
  const double t = (u * a.t + v * b.t + w * c.t) / (u + v + w);
  const double least = std::fmin(a.t, std::fmin(b.t, c.t)), most = std::fmax(a.t, std::fmax(b.t, c.t));
  // A triangle seen edge on has no weights worth the name.
  return t >= least ? (t <= most ? t : most) : least;
}

}  // namespace graycube::csg
