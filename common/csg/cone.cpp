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

bool move_cone(Primitive& p, double by) {
  // The radius at height z is (1 + k z): it grows by what a point moves across, and by what it
  // moves along.
  const double k = cone_slope(p);
  const double radius =
      1 + by * (stretch(p.to_local, 2) + std::fabs(k) * length(p.to_local.row(2)));
  if (!(radius > 0) || !move_caps(p, by)) return false;
  divide_rows(p.to_local, 2, radius);
  set_cone_slope(p, k / radius);
  // The caps of a smaller cone may reach beyond its apex, where the other nappe begins.
  const auto to_world = p.to_local.inverse();
  if (!to_world) return false;
  const Vec3 apex = to_world->point({0, 0, -1 / cone_slope(p)});
  set_caps(p, cap_normal(p), lower_cap(p), std::min(upper_cap(p), dot(cap_normal(p), apex)));
  return lower_cap(p) < upper_cap(p);
}

Aabb grown_cone_bounds(const Primitive& p, double by) {
  const double along = by * length(p.to_local.row(2));
  // Below its larger end the cone goes on widening.
  const double wider = by * stretch(p.to_local, 2) + 2 * std::fabs(cone_slope(p)) * along;
  return grown_bounds(p, {wider, wider, along});
}

}  // namespace graycube::csg
