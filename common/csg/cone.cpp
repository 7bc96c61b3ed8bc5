#include "csg/cylinder.hpp"

namespace graycube::csg {
namespace {

/// The part of the line with w0 + t·wd ≥ 0.
Interval positive_nappe(double w0, double wd) {
  if (wd == 0) return w0 >= 0 ? Interval{} : Interval{kInf, -kInf};
  const double apex = -w0 / wd;
  return wd > 0 ? Interval{apex, kInf} : Interval{-kInf, apex};
}

}  // namespace

Interval cone_interval(double k, const Vec3& o, const Vec3& d) {
  // Recentred at the point nearest the middle of the axis.
  const double nearest = -dot(o - Vec3{0, 0, 0.5}, d) / dot(d, d);
  const Vec3 q = o + nearest * d;
  const double w = 1 + k * q.z;
  const double wd = k * d.z;
  const double a = d.x * d.x + d.y * d.y - wd * wd;
  const double b = q.x * d.x + q.y * d.y - w * wd;
  const double c = q.x * q.x + q.y * q.y - w * w;
  // f(t) = a t² + 2 b t + c ≤ 0 inside the double cone.
  const double discriminant = b * b - a * c;
  Interval i;
  if (discriminant < 0) {
    if (a > 0) return {kInf, -kInf};
    i = positive_nappe(w, wd);  // through the apex, to within rounding
  } else {
    // The roots without cancellation; a may be anything down to zero.
    const double s = b >= 0 ? -(b + std::sqrt(discriminant)) : -b + std::sqrt(discriminant);
    const double r0 = s / a;
    const double r1 = c / s;
    const double lower = std::fmin(r0, r1);
    const double upper = std::fmax(r0, r1);
    if (s == 0) {
      // b = 0 and ac = 0: a tangent touches the cone at the nearest point, a line that lies in it
      // or passes through the apex stays in it on one nappe.
      if (a > 0) {
        i = {0, 0};
      } else if (c <= 0) {
        i = positive_nappe(w, wd);
      } else {
        return {kInf, -kInf};
      }
    } else if (a > 0) {
      i = {lower, upper};
    } else if (a < 0) {
      i = wd > 0 ? Interval{upper, kInf} : Interval{-kInf, lower};
    } else {
      i = b > 0 ? Interval{-kInf, r1} : Interval{r1, kInf};
    }
  }
  return {i.enter + nearest, i.leave + nearest};
}

}  // namespace graycube::csg
