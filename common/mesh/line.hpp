// Which triangles of a mesh a line passes through. The mesh is sheared so that the line becomes an
// axis (Woop, Benthin & Wald 2013); then the question is how often each triangle's outline winds
// around the origin of a plane. That is counted edge by edge: an edge of which exactly one end lies
// above the x axis counts where it cuts the axis' positive half, +1 upwards and −1 downwards. Since
// an edge seen the other way counts the negative, whatever was rounded before, the counts of all
// triangles of a closed mesh always add up to zero; and since the side on which the origin lies of
// an edge is found exactly, each triangle's count is −1, 0 or 1. Lines through vertices and along
// edges need no rule of their own: one triangle takes them, as if the line were moved by next to
// nothing.
#pragma once

#include <cmath>

#include "geometry/ray.hpp"

namespace graycube::csg {

/// The coordinates of a point across the line, in the sheared space.
struct LinePoint {
  double x, y;
};

class MeshLine {
 public:
  explicit MeshLine(const Ray& ray) : origin_(ray.origin) {
    const Vec3& d = ray.direction;
    int along = 0;
    for (int a = 1; a < 3; ++a) {
      if (std::fabs(d[a]) > std::fabs(d[along])) along = a;
    }
    // The same plane for both senses of a line: reversed, it passes through the same triangles.
    const int x = (along + 1) % 3, y = (along + 2) % 3;
    turn_ = d[along] > 0 ? -1 : 1;
    const double inverse = 1.0 / d[along];
    x_[x] = 1;
    x_[along] = -(d[x] * inverse);
    y_[y] = 1;
    y_[along] = -(d[y] * inverse);
    t_[along] = inverse;
  }

  LinePoint see(const Vec3& p) const {
    const Vec3 q = p - origin_;
    return {dot(x_, q), dot(y_, q)};
  }
  const Vec3& origin() const { return origin_; }
  const Vec3& x_axis() const { return x_; }
  const Vec3& y_axis() const { return y_; }
  /// The factor from a triangle's winding in the plane to the count of the line's cut: −1 if the
  /// line's direction is along the plane's normal.
  int turn() const { return turn_; }
  /// The parameter at which the line passes the point.
  double parameter(const Vec3& p) const { return dot(t_, p - origin_); }

 private:
  Vec3 origin_, x_, y_, t_;
  int turn_ = 1;
};

/// The sign of a.x b.y − a.y b.x, exact but for underflow. Rounded products that differ are in the
/// order of the exact ones; of equal ones the rounding errors decide, which a fused multiply-add
/// gives exactly, on every machine.
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

/// How often a triangle's outline winds around the line, in the plane.
inline int winding_of(const LinePoint& a, const LinePoint& b, const LinePoint& c) {
  return edge_count(a, b) + edge_count(b, c) + edge_count(c, a);
}

/// +1 where the line enters through the triangle's outside, −1 where it leaves through it, 0 where
/// it passes by.
inline int triangle_count(const MeshLine& line, const Vec3& p, const Vec3& q, const Vec3& r) {
  return line.turn() * winding_of(line.see(p), line.see(q), line.see(r));
}

/// The parameter at which the line meets the triangle's plane, kept between those of the corners.
/// The expression is that of all planes (geometry/interval.hpp), so that faces along the axes tie
/// with boxes'. A triangle seen edge on, or without an area, has no reliable plane: then the
/// corners' parameters are weighted by where the line passes.
double triangle_parameter(const MeshLine& line, const Ray& ray, const Vec3& a, const Vec3& b,
                          const Vec3& c);

/// A plane that the line meets at less than this sine counts as seen edge on.
inline constexpr double kLeastSine = 1e-6;

}  // namespace graycube::csg
