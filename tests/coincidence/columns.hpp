// Columns: solids that stand along z between two heights, whose sides don't depend on where they
// are cut off. A cut of the same sides may thus end flush with a face, or go on beyond it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include "csg/random_model.hpp"
#include "mesh/samples.hpp"

namespace graycube::testing {

enum class ColumnKind : std::uint8_t {
  kBox,
  kParallelepiped,
  kPolyhedron,
  kPrism,
  kMesh,
  kHalfSpaces,
  kCylinder,
  kSkewCylinder,
  kCone,
  kEllipticCone,
  kQuadric,
  kBall,
  kEllipsoid,
  kTorus,
};
inline constexpr std::size_t kColumnKinds = 14;
/// The kinds below this number have plane sides.
inline constexpr std::size_t kFlatColumnKinds = 6;

/// The heights between which a column's sides are meant to be seen; they go on a little beyond.
struct Stretch {
  double lo = 0, hi = 0, beyond = 0;
  double middle() const { return 0.5 * (lo + hi); }
  double half() const { return 0.5 * (hi - lo) + beyond; }
};

class Column {
 public:
  /// A column about (x, y), of a radius of about `r`. `is_exact`: a kind with plane sides, and
  /// numbers for which all arithmetic is exact.
  Column(ColumnKind kind, double x, double y, double r, const Stretch& stretch, Dice& dice,
         bool is_exact = false)
      : kind_(kind), x_(x), y_(y), r_(r), stretch_(stretch) {
    a_ = is_exact ? 1 : dice.between(0.75, 1);
    b_ = is_exact ? 0.75 : dice.between(0.75, 1);
    phase_degrees_ = dice.between(0, 360);
    sides_ = 5 + static_cast<std::uint32_t>(dice.below(4));
    // At most a tenth of the radius, over the whole stretch.
    const double slope = 0.1 * r / stretch.half();
    lean_x_ = is_exact ? 0 : dice.sign() * dice.between(0.3, 1) * slope;
    lean_y_ = is_exact ? 0 : dice.sign() * dice.between(0.3, 1) * slope;
    narrowing_ = dice.sign() * dice.between(0.5, 1) * slope;
  }

  /// The disc of radius inner() lies within the sides at all heights of the stretch, and that of
  /// radius outer() around them.
  double inner() const { return kind_ == ColumnKind::kTorus ? 0 : 0.6 * r_; }
  double outer() const {
    return static_cast<std::size_t>(kind_) < kFlatColumnKinds ? 1.55 * r_ : 1.3 * r_;
  }
  double x() const { return x_; }
  double y() const { return y_; }
  ColumnKind kind() const { return kind_; }

  /// Whether a column of that kind has room: a ball and a ring must be higher than the stretch.
  static bool fits(ColumnKind kind, double r, const Stretch& stretch) {
    if (kind == ColumnKind::kTorus) return stretch.half() < 0.38 * r;
    if (kind == ColumnKind::kBall || kind == ColumnKind::kEllipsoid)
      return stretch.half() < 0.55 * r;
    return true;
  }

  CsgNode between(double lo, double hi) const {
    switch (kind_) {
      case ColumnKind::kBox: return node_of(box(lo, hi));
      case ColumnKind::kParallelepiped: return transformed(node_of(box(lo, hi)), lean());
      case ColumnKind::kPolyhedron: return node_of(PolyhedronShape{planes(lo, hi)});
      case ColumnKind::kPrism: return prism(lo, hi);
      case ColumnKind::kMesh: return mesh(lo, hi);
      case ColumnKind::kHalfSpaces: return half_spaces(planes(lo, hi));
      case ColumnKind::kCylinder: return cylinder(lo, hi);
      case ColumnKind::kSkewCylinder: return transformed(cylinder(lo, hi), lean());
      case ColumnKind::kCone:
        return node_of(ConeShape{{x_, y_, lo}, radius(lo), {x_, y_, hi}, radius(hi)});
      case ColumnKind::kEllipticCone: return elliptic_cone(lo, hi);
      case ColumnKind::kQuadric: return quadric(lo, hi);
      case ColumnKind::kBall: return slab(node_of(SphereShape{middle(), 1.2 * r_}), lo, hi);
      case ColumnKind::kEllipsoid: return slab(ellipsoid(), lo, hi);
      default: return slab(node_of(TorusShape{middle(), {0, 0, 1}, 0.6 * r_, 0.4 * r_}), lo, hi);
    }
  }

 private:
  Vec3 middle() const { return {x_, y_, stretch_.middle()}; }
  double radius(double z) const { return r_ + narrowing_ * (z - stretch_.middle()); }
  BoxShape box(double lo, double hi) const {
    return {{x_ - a_ * r_, y_ - b_ * r_, lo}, {x_ + a_ * r_, y_ + b_ * r_, hi}};
  }
  CsgNode cylinder(double lo, double hi) const {
    return node_of(CylinderShape{{x_, y_, lo}, {x_, y_, hi}, r_});
  }
  /// A map under which planes of constant z stay where they are.
  Affine lean() const {
    Affine a;
    a.m[0][2] = lean_x_;
    a.m[1][2] = lean_y_;
    a.m[0][3] = -lean_x_ * stretch_.middle();
    a.m[1][3] = -lean_y_ * stretch_.middle();
    return a;
  }
  std::vector<HalfSpaceShape> planes(double lo, double hi) const {
    std::vector<HalfSpaceShape> p{{{0, 0, 1}, hi}, {{0, 0, -1}, -lo}};
    for (std::uint32_t i = 0; i < sides_; ++i) {
      const double at = phase_degrees_ + 360.0 * i / sides_;
      const Vec3 n{cos_degrees(at), sin_degrees(at), narrowing_};
      p.push_back({n, dot(n, middle()) + 0.95 * r_});
    }
    return p;
  }
  std::vector<FlatPoint> corners() const {
    std::vector<FlatPoint> points;
    for (std::uint32_t i = 0; i < sides_; ++i) {
      const double at = phase_degrees_ + 360.0 * i / sides_;
      points.push_back({x_ + r_ * cos_degrees(at), y_ + r_ * sin_degrees(at)});
    }
    return points;
  }
  CsgNode prism(double lo, double hi) const {
    return node_of(PrismShape{corners(), {}, hi - lo, lo});
  }
  CsgNode mesh(double lo, double hi) const {
    PolygonMesh polygons;
    for (const double z : {lo, hi}) {
      for (const FlatPoint& p : corners()) polygons.points.push_back({p.x, p.y, z});
    }
    std::vector<std::uint32_t> lid(sides_);
    std::iota(lid.begin(), lid.end(), sides_);
    polygons.add_face(lid);
    for (std::uint32_t i = 0; i < sides_; ++i) lid[i] = sides_ - 1 - i;
    polygons.add_face(lid);
    for (std::uint32_t i = 0; i < sides_; ++i) {
      const std::uint32_t next = (i + 1) % sides_;
      polygons.add_face(std::array{i, next, sides_ + next, sides_ + i});
    }
    return node_of(MeshShape{closed(polygons)});
  }
  static CsgNode half_spaces(const std::vector<HalfSpaceShape>& planes) {
    std::vector<CsgNode> sides;
    for (const HalfSpaceShape& h : planes) sides.push_back(node_of(h));
    return operation(Operation::kIntersection, std::move(sides));
  }
  CsgNode elliptic_cone(double lo, double hi) const {
    const auto along_a = [&](double z) { return a_ * radius(z); };
    const auto along_b = [&](double z) { return b_ * (2 * r_ - radius(z)); };
    const double c = cos_degrees(phase_degrees_), s = sin_degrees(phase_degrees_);
    return node_of(EllipticConeShape{{x_, y_, lo},
                                     {x_, y_, hi},
                                     along_a(lo) * Vec3{c, s, 0},
                                     along_b(lo) * Vec3{-s, c, 0},
                                     along_a(hi) / along_a(lo),
                                     along_b(hi) / along_b(lo)});
  }
  /// The solid x² + b y² + k z ≤ r² about the axis.
  CsgNode quadric(double lo, double hi) const {
    const double k = narrowing_ * r_;
    const QuadricShape q{{b_, 0, k, -r_ * r_},
                         {-2 * r_, -2 * r_, lo - stretch_.middle()},
                         {2 * r_, 2 * r_, hi - stretch_.middle()}};
    return transformed(node_of(q), translation(middle()));
  }
  CsgNode ellipsoid() const {
    const double c = cos_degrees(phase_degrees_), s = sin_degrees(phase_degrees_);
    return node_of(EllipsoidShape{
        middle(),
        {1.2 * r_ * Vec3{c, s, 0}, a_ * 1.2 * r_ * Vec3{-s, c, 0}, 1.1 * r_ * Vec3{0.1, 0, 1}}});
  }
  static CsgNode slab(CsgNode whole, double lo, double hi) {
    return operation(Operation::kIntersection,
                     {std::move(whole), node_of(HalfSpaceShape{{0, 0, 1}, hi}),
                      node_of(HalfSpaceShape{{0, 0, -1}, -lo})});
  }

  ColumnKind kind_;
  double x_, y_, r_;
  Stretch stretch_;
  double a_ = 1, b_ = 1, phase_degrees_ = 0, lean_x_ = 0, lean_y_ = 0, narrowing_ = 0;
  std::uint32_t sides_ = 5;
};

}  // namespace graycube::testing
