// On which side of planes through the eye, and of planes across the view, a ray is, and when: the
// order of a BSP in the coordinates of a CameraSpace.
//
// A plane is where f = x − c z, or z − c, is 0. Along the ray f = a + b t, and the ray's side is
// decided by t: where b > 0 it is on the upper side when t ≥ −a/b, where b < 0 when t < −a/b, and
// else when a ≥ 0. All planes through the eye meet there, so that points would not do.
#pragma once

#include "subdivisions/camera_space.hpp"
#include "subdivisions/plane_order.hpp"

namespace graycube {

class FrustumOrder {
 public:
  FrustumOrder(const CameraSpace& space, const Ray& ray)
      : line_(space.line_of(ray)), is_perspective_(space.is_perspective()) {
    if (!is_perspective_) flat_ = kFlat * max_abs(line_.direction);
  }

  /// The ray in the camera's x, y and z.
  const Ray& line() const { return line_; }
  /// Whether the ray is parallel to all planes of an orthographic camera's screen.
  bool is_along_view() const {
    return std::fabs(line_.direction.x) <= flat_ && std::fabs(line_.direction.y) <= flat_;
  }
  bool is_above(int axis, double at, double t) const {
    const Form f = form(axis, at);
    if (f.b > flat_) return t >= -f.a / f.b;
    if (f.b < -flat_) return t < -f.a / f.b;
    return f.a >= 0;
  }
  /// The parameter at which the ray leaves through a face to its outer side; infinite if it never
  /// does.
  double leaves_at(int axis, double at, bool upper) const {
    const Form f = form(axis, at);
    return (upper ? f.b > flat_ : f.b < -flat_) ? -f.a / f.b : kInf;
  }

 private:
  /// An orthographic camera's axes are orthogonal only to within rounding, and a primary ray must
  /// stay in its column of the screen: what is less steep counts as parallel.
  static constexpr double kFlat = 1e-14;

  struct Form {
    double a, b;
  };
  Form form(int axis, double at) const {
    if (axis == 2 || !is_perspective_) return {line_.origin[axis] - at, line_.direction[axis]};
    return {line_.origin[axis] - at * line_.origin.z,
            line_.direction[axis] - at * line_.direction.z};
  }

  Ray line_;
  bool is_perspective_;
  double flat_ = 0;
};

inline CellExit exit_of(const Aabb& cell, const FrustumOrder& order) {
  CellExit exit;
  for (int a = 0; a < 3; ++a) {
    for (const bool upper : {false, true}) {
      const double at = (upper ? cell.hi : cell.lo)[a];
      if (!std::isfinite(at)) continue;
      const double t = order.leaves_at(a, at, upper);
      if (t < exit.t) exit = {t, a * 2 + (upper ? 1 : 0)};
    }
  }
  return exit;
}

}  // namespace graycube
