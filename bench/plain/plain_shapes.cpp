#include "bench/plain/plain_shapes.hpp"

#include <algorithm>
#include <cmath>

namespace graycube::plain {
namespace {

/// Clips the interval to the parameters t with lo ≤ o + t d ≤ hi.
void clip_to_slab(Interval& i, double lo, double hi, double o, double d, double inverse) {
  if (d == 0) {
    if (o < lo || o > hi) i = {kInf, -kInf};
    return;
  }
  const double a = (lo - o) * inverse;
  const double b = (hi - o) * inverse;
  i.clip(std::min(a, b), std::max(a, b));
}

template <std::size_t kCount>
double horner(const std::array<double, kCount>& c, double t) {
  double v = c[kCount - 1];
  for (std::size_t i = kCount - 1; i-- > 0;) v = v * t + c[i];
  return v;
}

/// The root in [a, b], at whose ends the signs differ: Newton's method, bisecting where that
/// strays.
template <std::size_t kCount>
double root_between(const std::array<double, kCount>& c,
                    const std::array<double, kCount - 1>& derivative, double a, double b) {
  constexpr int kMaxSteps = 100;
  const bool rises = horner(c, a) < 0;
  double t = 0.5 * (a + b);
  for (int step = 0; step < kMaxSteps; ++step) {
    const double v = horner(c, t);
    ((v < 0) == rises ? a : b) = t;
    double next = t - v / horner(derivative, t);
    if (!(next > a && next < b)) next = 0.5 * (a + b);
    if (std::fabs(next - t) <= 1e-15 * std::fabs(t)) break;
    t = next;
  }
  return t;
}

/// A polynomial's real roots in [lo, hi], ascending: between the roots of its derivative it is
/// monotone.
template <std::size_t kCount>
std::size_t roots_of(const std::array<double, kCount>& c, double lo, double hi,
                     std::array<double, kCount - 1>& roots) {
  std::array<double, kCount - 1> derivative{};
  for (std::size_t i = 1; i < kCount; ++i) derivative[i - 1] = static_cast<double>(i) * c[i];
  std::array<double, kCount> knots{lo};
  std::size_t n = 1;
  if constexpr (kCount > 2) {
    std::array<double, kCount - 2> turns{};
    const std::size_t count = roots_of(derivative, lo, hi, turns);
    for (std::size_t i = 0; i < count; ++i) knots[n++] = turns[i];
  }
  knots[n] = hi;
  std::size_t found = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if ((horner(c, knots[k]) < 0) == (horner(c, knots[k + 1]) < 0)) continue;
    roots[found++] = root_between(c, derivative, knots[k], knots[k + 1]);
  }
  return found;
}

/// Two unit vectors square to a unit one.
std::array<Vec3, 2> across(const Vec3& axis) {
  const Vec3 other = std::fabs(axis.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = normalized(cross(axis, other));
  return {u, cross(axis, u)};
}

/// Grows bounds to hold the image of a disc; of a ball with all three unit axes.
template <std::size_t kCount>
void include_ellipse(Aabb& box, const Affine& map, const Vec3& center, double radius,
                     const std::array<Vec3, kCount>& axes) {
  const Vec3 c = map.point(center);
  Vec3 e;
  for (const Vec3& axis : axes) {
    const Vec3 v = map.vector(axis);
    e = e + Vec3{v.x * v.x, v.y * v.y, v.z * v.z};
  }
  e = radius * Vec3{std::sqrt(e.x), std::sqrt(e.y), std::sqrt(e.z)};
  box.include(c - e);
  box.include(c + e);
}

constexpr std::array<Vec3, 3> kAxes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

Aabb image_bounds(const Ball& b, const Affine& map) {
  Aabb box = Aabb::nothing();
  include_ellipse(box, map, b.center, b.radius, kAxes);
  return box;
}
Aabb image_bounds(const Block& b, const Affine& map) {
  Aabb box = Aabb::nothing();
  for (int i = 0; i < 8; ++i) box.include(map.point(Aabb{b.lo, b.hi}.corner(i)));
  return box;
}
Aabb image_bounds(const Tube& t, const Affine& map) {
  Aabb box = Aabb::nothing();
  include_ellipse(box, map, t.base, t.radius, across(t.axis));
  include_ellipse(box, map, t.base + t.height * t.axis, t.radius + t.slope * t.height,
                  across(t.axis));
  return box;
}
Aabb image_bounds(const Ring& r, const Affine& map) {
  Aabb box = Aabb::nothing();
  include_ellipse(box, map, r.center, r.major + r.minor, across(r.axis));
  Aabb tube = Aabb::nothing();
  include_ellipse(tube, map, {}, r.minor, kAxes);
  const Vec3 e = 0.5 * (tube.hi - tube.lo);
  return {box.lo - e, box.hi + e};
}
Aabb image_bounds(const Planes&, const Affine&) { return Aabb::everything(); }

Vec3 shape_normal(const Ball& b, const Vec3& p) { return p - b.center; }
Vec3 shape_normal(const Block& b, const Vec3& p) {
  double nearest = kInf;
  Vec3 normal;
  for (int a = 0; a < 3; ++a) {
    for (const double side : {-1.0, 1.0}) {
      const double distance = std::fabs(p[a] - (side < 0 ? b.lo[a] : b.hi[a]));
      if (distance >= nearest) continue;
      nearest = distance;
      normal = {};
      normal[a] = side;
    }
  }
  return normal;
}
Vec3 shape_normal(const Tube& t, const Vec3& p) {
  const Vec3 q = p - t.base;
  const double h = dot(q, t.axis);
  const Vec3 out = normalized(q - h * t.axis);
  const double side = std::fabs(dot(q, out) - t.radius - t.slope * h);
  if (std::fabs(h) < std::min(side, std::fabs(h - t.height))) return -t.axis;
  if (std::fabs(h - t.height) < side) return t.axis;
  return out - t.slope * t.axis;
}
Vec3 shape_normal(const Ring& r, const Vec3& p) {
  const Vec3 q = p - r.center;
  const Vec3 level = normalized(q - dot(q, r.axis) * r.axis);
  return q - r.major * level;
}
Vec3 shape_normal(const Planes& p, const Vec3& q) {
  const auto distance = [&](const HalfSpaceShape& h) {
    return std::fabs(dot(h.normal, q) - h.offset) / length(h.normal);
  };
  const auto nearest = std::min_element(
      p.planes.begin(), p.planes.end(),
      [&](const HalfSpaceShape& a, const HalfSpaceShape& b) { return distance(a) < distance(b); });
  return nearest->normal;
}

Shape tube(const Vec3& base, double base_radius, const Vec3& top, double top_radius) {
  const double height = length(top - base);
  return Tube{base, (1 / height) * (top - base), height, base_radius,
              (top_radius - base_radius) / height};
}

}  // namespace

Intervals intervals(const Ball& b, const Line& line) {
  const double dd = dot(line.direction, line.direction);
  const Vec3 oc = b.center - line.origin;
  const double middle = dot(oc, line.direction) / dd;
  const Vec3 q = middle * line.direction - oc;
  const double h2 = (b.radius * b.radius - dot(q, q)) / dd;
  Intervals result;
  if (h2 > 0) result.add({middle - std::sqrt(h2), middle + std::sqrt(h2)});
  return result;
}

Intervals intervals(const Block& b, const Line& line) {
  Interval i;
  for (int a = 0; a < 3; ++a) {
    clip_to_slab(i, b.lo[a], b.hi[a], line.origin[a], line.direction[a], line.inverse[a]);
  }
  Intervals result;
  result.add(i);
  return result;
}

Intervals intervals(const Tube& t, const Line& line) {
  const Vec3& d = line.direction;
  const double near = dot(t.base - line.origin, d) / dot(d, d);
  const Vec3 o = line.origin + near * d - t.base;
  const double oz = dot(o, t.axis);
  const double dz = dot(d, t.axis);
  Interval slab;
  clip_to_slab(slab, 0, t.height, oz, dz, 1 / dz);
  const double r = t.radius + t.slope * oz;
  const double a = dot(d, d) - dz * dz - t.slope * t.slope * dz * dz;
  const double b = dot(o, d) - oz * dz - t.slope * dz * r;
  const double c = dot(o, o) - oz * oz - r * r;
  const double discriminant = b * b - a * c;
  Interval inside = slab;
  if (std::fabs(a) < 1e-14 * dot(d, d)) {
    if (b == 0 && c > 0) return {};
    if (b > 0) inside.clip(-kInf, -c / (2 * b));
    if (b < 0) inside.clip(-c / (2 * b), kInf);
  } else if (discriminant >= 0) {
    const double q = -(b + std::copysign(std::sqrt(discriminant), b));
    const double t0 = q == 0 ? 0 : std::min(q / a, c / q);
    const double t1 = q == 0 ? 0 : std::max(q / a, c / q);
    if (a > 0) {
      inside.clip(t0, t1);
    } else {  // the two nappes of the cone; the caps leave one of them
      inside.clip(-kInf, t0);
      if (inside.is_empty()) {
        inside = slab;
        inside.clip(t1, kInf);
      }
    }
  } else if (a > 0) {
    return {};
  }
  Intervals result;
  result.add({inside.enter + near, inside.leave + near});
  return result;
}

Intervals intervals(const Ring& r, const Line& line) {
  const double size = length(line.direction);
  const Vec3 d = (1 / size) * line.direction;
  const double near = dot(r.center - line.origin, d);
  const Vec3 o = line.origin + near * d - r.center;
  const double reach2 = (r.major + r.minor) * (r.major + r.minor) - dot(o, o);
  if (!(reach2 > 0)) return {};
  const double reach = std::sqrt(reach2);
  // (p·p + R² − r²)² = 4 R² (p·p − (p·a)²), with o·d = 0.
  const double k = dot(o, o) + r.major * r.major - r.minor * r.minor;
  const double oz = dot(o, r.axis);
  const double dz = dot(d, r.axis);
  const double f = 4 * r.major * r.major;
  const std::array<double, 5> c{k * k - f * (dot(o, o) - oz * oz), 2 * f * oz * dz,
                                2 * k - f * (1 - dz * dz), 0, 1};
  std::array<double, 4> roots{};
  const std::size_t n = roots_of(c, -reach, reach, roots);
  Intervals result;
  for (std::size_t i = 0; i + 1 < n; i += 2) {
    result.add({(roots[i] + near) / size, (roots[i + 1] + near) / size});
  }
  return result;
}

Intervals intervals(const Planes& p, const Line& line) {
  Interval i;
  for (const HalfSpaceShape& h : p.planes) {
    const double d = dot(h.normal, line.direction);
    clip_to_slab(i, -kInf, h.offset, dot(h.normal, line.origin), d, 1 / d);
  }
  Intervals result;
  result.add(i);
  return result;
}

Vec3 normal_at(const Shape& shape, const Vec3& point) {
  return std::visit([&](const auto& s) { return shape_normal(s, point); }, shape);
}

Aabb bounds_of(const Shape& shape, const Affine& map) {
  return std::visit([&](const auto& s) { return image_bounds(s, map); }, shape);
}

PlainLeaf plain_leaf(const SphereShape& s) { return {Ball{s.center, s.radius}, {}}; }
PlainLeaf plain_leaf(const BoxShape& s) { return {Block{s.min, s.max}, {}}; }
PlainLeaf plain_leaf(const CylinderShape& s) {
  return {tube(s.base, s.radius, s.top, s.radius), {}};
}
PlainLeaf plain_leaf(const ConeShape& s) {
  return {tube(s.base, s.base_radius, s.top, s.top_radius), {}};
}
PlainLeaf plain_leaf(const TorusShape& s) {
  return {Ring{s.center, normalized(s.axis), s.major, s.minor}, {}};
}
PlainLeaf plain_leaf(const HalfSpaceShape& s) { return {Planes{{s}}, {}}; }
PlainLeaf plain_leaf(const EllipsoidShape& s) {
  Affine map;
  for (std::size_t i = 0; i < 3; ++i) {
    const int row = static_cast<int>(i);
    map.m[i] = {s.axes[0][row], s.axes[1][row], s.axes[2][row], s.center[row]};
  }
  return {Ball{{}, 1}, map};
}
PlainLeaf plain_leaf(const PolyhedronShape& s) { return {Planes{s.planes}, {}}; }

}  // namespace graycube::plain
