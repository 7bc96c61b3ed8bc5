#include "coincidence/surface_numbers.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "check.hpp"
#include "coincidence/heading.hpp"
#include "csg/cylinder.hpp"
#include "csg/elliptic_cone.hpp"
#include "csg/elliptic_torus.hpp"
#include "csg/quadric.hpp"
#include "csg/sphere.hpp"
#include "csg/torus.hpp"

namespace graycube::csg {
namespace {

/// A symmetric matrix, as its entries xx, yy, zz, xy, yz, zx.
struct Form {
  std::array<double, 6> m{};

  void add(const Vec3& v, double factor) {
    const std::array<double, 6> products{v.x * v.x, v.y * v.y, v.z * v.z,
                                         v.x * v.y, v.y * v.z, v.z * v.x};
    for (std::size_t i = 0; i < 6; ++i) m[i] += factor * products[i];
  }
};
Form form_of(const Vec3& v) {
  Form f;
  f.add(v, 1);
  return f;
}

/// Takes a surface's numbers in turn, and keeps the one that is wanted.
class Numbers {
 public:
  explicit Numbers(int wanted) : wanted_(wanted) {}

  void number(double value, double tolerance) {
    if (wanted_-- == 0) found_ = {value, tolerance};
  }
  /// Takes the numbers of a point; returns whether the wanted one was among those so far.
  bool point(const Vec3& p, double tolerance) {
    number(dot(kGenericDirection, p), 2 * tolerance);
    if (is_done()) return true;
    for (int a = 0; a < 3; ++a) number(p[a], tolerance);
    return is_done();
  }
  void form(const Form& f, double tolerance) {
    for (const double v : f.m) number(v, tolerance);
  }
  bool is_done() const { return wanted_ < 0; }
  Measured found() const { return found_; }

 private:
  int wanted_;
  Measured found_;
};

double column(const Affine& map, int row) { return map.m[static_cast<std::size_t>(row)][3]; }
double square(const Vec3& v) { return dot(v, v); }

/// How far off forms of the frame's rows, of squared length `square`, may be: relatively by the
/// error of places over the surface's size, and by that of directions.
double form_tolerance(const Exactness& e, double square) {
  return 2 * square * (e.distance() * std::sqrt(square) + e.direction);
}

void ball_numbers(const Primitive& p, const Exactness& e, Numbers& n) {
  const bool is_sphere = p.kind == PrimitiveKind::kSphere;
  const Vec3 center = is_sphere ? sphere_center(p.v) : p.bounds.center();
  if (n.point(center, e.distance())) return;
  const double r = sphere_radius(p.v);
  const Vec3 reach = is_sphere ? Vec3{r, r, r} : 0.5 * (p.bounds.hi - p.bounds.lo);
  for (int a = 0; a < 3; ++a) n.number(reach[a], e.distance());
  Form f;
  double most = 0;
  for (int a = 0; a < 3; ++a) {
    Vec3 row = p.to_local.row(a);
    if (is_sphere) row = (1 / r) * row;
    f.add(row, 1);
    most = larger(square(row), most);
  }
  n.form(f, form_tolerance(e, most));
}

void cylinder_numbers(const Primitive& p, const Exactness& e, Numbers& n) {
  const Vec3 x = p.to_local.row(0), y = p.to_local.row(1), along = cross(x, y);
  // The point of the axis nearest the origin.
  const Vec3 foot = (1 / square(along)) * (-column(p.to_local, 0) * cross(y, along) -
                                           column(p.to_local, 1) * cross(along, x));
  const double beside = p.bounds.is_finite() ? length(p.bounds.center() - foot) : 0;
  if (n.point(foot, e.distance() + e.direction * beside)) return;
  Form across = form_of(x);
  across.add(y, 1);
  n.form(across, form_tolerance(e, larger(square(x), square(y))));
  n.form(form_of(normalized(along)), 2 * e.direction);
}

void cone_numbers(const Primitive& p, const Exactness& e, Numbers& n) {
  const double k = cone_slope(p);
  const Vec3 x = p.to_local.row(0), y = p.to_local.row(1), w = k * p.to_local.row(2);
  const double determinant = dot(x, cross(y, w));
  const Vec3 apex = (-1 / determinant) *
                    (column(p.to_local, 0) * cross(y, w) + column(p.to_local, 1) * cross(w, x) +
                     (k * column(p.to_local, 2) + 1) * cross(x, y));
  const double size = length(p.bounds.hi - p.bounds.lo);
  const double angle = e.direction + e.distance() / size;
  const double off = e.distance() + angle * length(p.bounds.center() - apex);
  const double slope = std::sqrt(square(w) / larger(square(x), square(y)));
  if (n.point(apex, off * (1 + 1 / slope))) return;
  const double norm = square(x) + square(y) + square(w);
  Form f;
  f.add(x, 1 / norm);
  f.add(y, 1 / norm);
  f.add(w, -1 / norm);
  n.form(f, 4 * angle);
}

/// The numbers of a round or an elliptic torus.
void ring_numbers(const Primitive& p, const Exactness& e, Numbers& n) {
  if (n.point(p.bounds.center(), e.distance())) return;
  const Vec3 x = p.to_local.row(0), y = p.to_local.row(1), z = p.to_local.row(2);
  Form across = form_of(x);
  across.add(y, 1);
  n.form(across, form_tolerance(e, larger(square(x), square(y))));
  n.form(form_of(z), form_tolerance(e, square(z)));
  const double local = e.distance() * std::sqrt(larger(square(x), larger(square(y), square(z))));
  if (p.kind == PrimitiveKind::kTorus) return n.number(torus_minor(p), local);
  const Vec3 ellipse = ellipse_of(p);
  const double most = larger(ellipse.x, ellipse.z);
  const double tolerance = 2 * most * (local * std::sqrt(most) + e.direction);
  n.number(ellipse.x, tolerance);
  n.number(ellipse.z, tolerance);
  // The coefficient of (ρ − 1) z changes its sign with the frame's z, so both are multiplied.
  for (int a = 0; a < 3; ++a)
    n.number(ellipse.y * z[a], (tolerance + most * e.direction) * length(z));
}

/// One of an elliptic cone's two semi-axes: the plane from which it is measured, and its length, a
/// linear function of the place.
struct SemiAxis {
  Vec3 normal, foot;
  double length_at_origin;
  Vec3 growth;
};
SemiAxis semi_axis_of(const Primitive& p, int row, double k) {
  const Vec3 r = p.to_local.row(row);
  const double l = length(r);
  const Vec3 normal = (1 / l) * r;
  return {normal, (-column(p.to_local, row) / l) * normal, (1 - k * column(p.to_local, 2)) / l,
          (-k / l) * p.to_local.row(2)};
}

void elliptic_cone_numbers(const Primitive& p, const Exactness& e, Numbers& n) {
  SemiAxis first = semi_axis_of(p, 0, 1), second = semi_axis_of(p, 1, second_slope(p));
  // Which of them is the frame's x depends on where the frame begins, so they are put in order.
  if (std::fabs(dot(kGenericDirection, first.normal)) <
      std::fabs(dot(kGenericDirection, second.normal)))
    std::swap(first, second);
  const double size = length(p.bounds.hi - p.bounds.lo), away = length(p.bounds.center()) + size;
  const double angle = e.direction + e.distance() / size;
  for (const SemiAxis& a : {first, second}) {
    if (n.point(a.foot, e.distance() + angle * away)) return;
    n.form(form_of(a.normal), 2 * angle);
    n.number(a.length_at_origin, e.distance() + angle * away);
    for (int i = 0; i < 3; ++i) n.number(a.growth[i], 2 * angle);
  }
}

void quadric_numbers(const Primitive& p, const Exactness& e, Numbers& n) {
  const auto [of_yy, of_zz, of_z, of_one] = quadric_coefficients(p);
  const std::array<double, 3> factors{1, of_yy, of_zz};
  Form f;
  Vec3 slope;
  double constant = of_one + of_z * column(p.to_local, 2), norm = 0;
  for (int row = 0; row < 3; ++row) {
    const Vec3 r = p.to_local.row(row);
    const double factor = factors[static_cast<std::size_t>(row)], at = column(p.to_local, row);
    f.add(r, factor);
    slope = slope + (factor * at) * r;
    constant += factor * at * at;
    norm += std::fabs(factor) * square(r);
  }
  slope = slope + (0.5 * of_z) * p.to_local.row(2);
  const double size = length(p.bounds.hi - p.bounds.lo), away = length(p.bounds.center()) + size;
  const double angle = e.direction + e.distance() / size;
  const double off = e.distance() + angle * away;
  if (n.point((1 / norm) * slope, 4 * off)) return;
  for (double& v : f.m) v /= norm;
  n.form(f, 4 * angle);
  n.number(constant / norm, 4 * away * off);
}

void give_numbers(const Primitive& p, const Exactness& e, Numbers& n) {
  switch (family_of(p)) {
    case SurfaceFamily::kBall: return ball_numbers(p, e, n);
    case SurfaceFamily::kCylinder: return cylinder_numbers(p, e, n);
    case SurfaceFamily::kCone: return cone_numbers(p, e, n);
    case SurfaceFamily::kTorus:
    case SurfaceFamily::kEllipticTorus: return ring_numbers(p, e, n);
    case SurfaceFamily::kEllipticCone: return elliptic_cone_numbers(p, e, n);
    case SurfaceFamily::kQuadric: return quadric_numbers(p, e, n);
    case SurfaceFamily::kNone: return;
  }
}

}  // namespace

SurfaceFamily family_of(const Primitive& p) {
  switch (p.kind) {
    case PrimitiveKind::kSphere:
    case PrimitiveKind::kEllipsoid: return SurfaceFamily::kBall;
    case PrimitiveKind::kCylinder: return SurfaceFamily::kCylinder;
    case PrimitiveKind::kCone: return SurfaceFamily::kCone;
    case PrimitiveKind::kTorus: return SurfaceFamily::kTorus;
    case PrimitiveKind::kEllipticTorus: return SurfaceFamily::kEllipticTorus;
    case PrimitiveKind::kEllipticCone: return SurfaceFamily::kEllipticCone;
    case PrimitiveKind::kQuadric:
      return is_tube(p) ? SurfaceFamily::kCylinder : SurfaceFamily::kQuadric;
    default: return SurfaceFamily::kNone;
  }
}

int number_count(SurfaceFamily family) {
  switch (family) {
    case SurfaceFamily::kBall: return 13;
    case SurfaceFamily::kCylinder: return 16;
    case SurfaceFamily::kCone: return 10;
    case SurfaceFamily::kTorus: return 17;
    case SurfaceFamily::kEllipticTorus: return 21;
    case SurfaceFamily::kEllipticCone: return 28;
    case SurfaceFamily::kQuadric: return 11;
    case SurfaceFamily::kNone: return 0;
  }
  return 0;
}

Measured surface_number(const Primitive& p, const Exactness& exactness, int which) {
  Numbers numbers(which);
  give_numbers(p, exactness, numbers);
  GRAYCUBE_CHECK(numbers.is_done(), "number %d of kind %d", which, static_cast<int>(p.kind));
  return numbers.found();
}

}  // namespace graycube::csg
