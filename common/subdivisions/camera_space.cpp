#include "subdivisions/camera_space.hpp"

#include <cmath>

#include "csg/bounding_sphere.hpp"

namespace graycube {
namespace {

/// Spheres that come nearer to the plane of the eye than this share of their radius have such wide
/// outlines that rounding errors are no longer small against them.
constexpr double kLeastGap = 0.01;
/// Far larger than the relative rounding error of a corner's coordinates.
constexpr double kRounding = 1e-12;

/// The least and the largest x/z of what has these bounds of x and of z, and reaches down to z = 0.
void bound_slopes(double lo_x, double hi_x, double hi_z, double& lo, double& hi) {
  lo = lo_x < 0 ? -kInf : lo_x / hi_z;
  hi = hi_x > 0 ? kInf : hi_x / hi_z;
}

}  // namespace

CameraSpace::CameraSpace(const CameraFrame& frame, Direction direction)
    : is_perspective_(frame.projection == Projection::kPerspective),
      eye_(frame.eye),
      axes_{frame.right, frame.down,
            direction == Direction::kForward ? frame.forward : -frame.forward} {}

Aabb CameraSpace::everything() const {
  Aabb all = Aabb::everything();
  if (is_perspective_) all.lo.z = 0;
  return all;
}

Aabb CameraSpace::bounds_of(const Primitive& primitive, double grow) const {
  if (!primitive.bounds.is_finite()) return everything();
  Aabb bounds = projection_of(primitive.bounds.grown(grow), grow);
  if (bounds.is_empty()) return Aabb::nothing();
  if (const auto sphere = bounding_sphere(primitive)) {
    clip_to_sphere(place_of(sphere->center), sphere->radius + 2 * grow, bounds);
  }
  return bounds.is_empty() ? Aabb::nothing() : bounds;
}

/// Of a box of the world that is grown already; `grow` is used to tell what only touches z = 0.
Aabb CameraSpace::projection_of(const Aabb& box, double grow) const {
  Aabb plain = Aabb::nothing();
  Aabb slopes = Aabb::nothing();
  for (int i = 0; i < 8; ++i) {
    const Vec3 p = place_of(box.corner(i));
    plain.include(p);
    if (p.z > 0) slopes.include({p.x / p.z, p.y / p.z, p.z});
  }
  if (!is_perspective_) return plain;
  if (plain.hi.z <= 0) return Aabb::nothing();
  if (plain.lo.z > grow) return slopes;
  bound_slopes(plain.lo.x, plain.hi.x, plain.hi.z, slopes.lo.x, slopes.hi.x);
  bound_slopes(plain.lo.y, plain.hi.y, plain.hi.z, slopes.lo.y, slopes.hi.y);
  slopes.lo.z = plain.lo.z;
  slopes.hi.z = plain.hi.z;
  return slopes;
}

/// The outline of a sphere on the screen: planes x = c z touch it where |center.x − c center.z| =
/// r √(1 + c²), which is a quadratic equation of c.
void CameraSpace::clip_to_sphere(const Vec3& center, double radius, Aabb& bounds) const {
  Aabb outline{center - Vec3{radius, radius, radius}, center + Vec3{radius, radius, radius}};
  if (is_perspective_) {
    if (!(center.z > (1 + kLeastGap) * radius)) return;
    const double scale = 1 / (center.z * center.z - radius * radius);
    for (int a = 0; a < 2; ++a) {
      const double root = radius * std::sqrt(center[a] * center[a] + 1 / scale);
      outline.lo[a] = (center[a] * center.z - root) * scale;
      outline.hi[a] = (center[a] * center.z + root) * scale;
    }
  }
  bounds = intersection_of(bounds, outline);
}

Aabb CameraSpace::world_box(const Aabb& cell) const {
  if (!cell.is_finite()) return Aabb::everything();
  Aabb box = Aabb::nothing();
  for (int i = 0; i < 8; ++i) {
    Vec3 p = cell.corner(i);
    if (is_perspective_) p = {p.x * p.z, p.y * p.z, p.z};
    box.include(eye_ + p.x * axes_[0] + p.y * axes_[1] + p.z * axes_[2]);
  }
  return box.grown(kRounding * larger(max_abs(box.lo), max_abs(box.hi)));
}

}  // namespace graycube
