// The same solid told in other numbers: ends swapped, planes rescaled, a box as a polyhedron, a
// prism or a mesh, an ellipsoid by other axes, a rotation carried out in the numbers.
#pragma once

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "coincidence/chain.hpp"
#include "mesh/samples.hpp"

namespace graycube::testing {

/// The box as six planes.
inline PolyhedronShape polyhedron_of(const BoxShape& box) {
  PolyhedronShape p;
  for (int a = 0; a < 3; ++a) {
    Vec3 n;
    n[a] = 1;
    p.planes.push_back({n, box.max[a]});
    p.planes.push_back({-n, -box.min[a]});
  }
  return p;
}

/// Tells leaves in other numbers, as dice decide.
class Retelling {
 public:
  /// `across_kinds`: round solids may also become shapes of a more general kind.
  explicit Retelling(Dice& dice, bool across_kinds = false)
      : dice_(dice), across_kinds_(across_kinds) {}

  /// Tells all leaves of a tree anew; their order and maps stay.
  CsgNode operator()(const CsgNode& node) {
    CsgNode told = std::visit([&](const auto& shape) { return tell(shape); }, node.value);
    told.material = node.material;
    if (!node.transform) return told;
    if (told.transform) told = operation(Operation::kUnion, {std::move(told)});
    told.transform = *node.transform;
    return told;
  }

 private:
  CsgNode tell(const OperationNode& o) {
    OperationNode told{o.operation, {}};
    for (const CsgNode& child : o.children) told.children.push_back((*this)(child));
    return node_of(std::move(told));
  }
  CsgNode tell(const BoxShape& b) {
    switch (dice_.below(6)) {
      case 0: return tell(polyhedron_of(b));
      case 1: return node_of(MeshShape{closed(box_polygons(b.min, b.max))});
      case 2: return tell(prism_of_box(b));
      case 3: return quarter_turned(b);
      case 4: {
        std::vector<CsgNode> sides;
        for (const HalfSpaceShape& h : polyhedron_of(b).planes) sides.push_back(tell(h));
        return operation(Operation::kIntersection, std::move(sides));
      }
      default: return node_of(b);
    }
  }
  static PrismShape prism_of_box(const BoxShape& b) {
    return {{{b.min.x, b.min.y}, {b.max.x, b.min.y}, {b.max.x, b.max.y}, {b.min.x, b.max.y}},
            {},
            b.max.z - b.min.z,
            b.min.z};
  }
  /// The box turned back in its numbers, and forth again by a map.
  CsgNode quarter_turned(const BoxShape& b) {
    const Vec3 axis = dice_.axis();
    const double angle = 90.0 * static_cast<double>(1 + dice_.below(3));
    const Affine back = rotation(axis, -angle);
    Aabb turned = Aabb::nothing();
    turned.include(back.point(b.min));
    turned.include(back.point(b.max));
    return transformed(node_of(BoxShape{turned.lo, turned.hi}), rotation(axis, angle));
  }
  CsgNode tell(const PolyhedronShape& p) {
    PolyhedronShape told = p;
    for (HalfSpaceShape& h : told.planes) h = rescaled(h);
    std::rotate(told.planes.begin(),
                told.planes.begin() + static_cast<std::ptrdiff_t>(dice_.below(told.planes.size())),
                told.planes.end());
    return node_of(std::move(told));
  }
  HalfSpaceShape rescaled(const HalfSpaceShape& h) {
    const double s = dice_.one_in(3) ? 1 : dice_.between(0.3, 3);
    return {s * h.normal, s * h.offset};
  }
  CsgNode tell(const HalfSpaceShape& h) {
    if (dice_.one_in(2)) return node_of(rescaled(h));
    return node_of(PolyhedronShape{{rescaled(h)}});
  }
  CsgNode tell(const PrismShape& p) {
    PrismShape told = p;
    if (told.paths.empty()) {
      std::rotate(
          told.points.begin(),
          told.points.begin() + static_cast<std::ptrdiff_t>(dice_.below(told.points.size())),
          told.points.end());
    }
    return node_of(std::move(told));
  }
  CsgNode tell(const CylinderShape& c) {
    const double r = c.radius;
    const Vec3 axis = c.top - c.base;
    if (across_kinds_ && axis.x == 0 && axis.y == 0 && dice_.one_in(2)) {
      const QuadricShape round{{1, 0, 0, -r * r}, {-2 * r, -2 * r, 0}, {2 * r, 2 * r, axis.z}};
      return transformed(node_of(round), translation(c.base));
    }
    switch (dice_.below(4)) {
      case 0: return node_of(CylinderShape{c.top, c.base, c.radius});
      case 1: return node_of(ConeShape{c.base, c.radius, c.top, c.radius});
      case 2: {
        const Affine size = scaling({c.radius, c.radius, c.radius});
        const double back = 1 / c.radius;
        return transformed(node_of(CylinderShape{back * c.base, back * c.top, 1}), size);
      }
      default: return node_of(c);
    }
  }
  CsgNode tell(const ConeShape& c) {
    if (dice_.one_in(2)) return node_of(c);
    return node_of(ConeShape{c.top, c.top_radius, c.base, c.base_radius});
  }
  CsgNode tell(const SphereShape& s) {
    if (across_kinds_ && dice_.one_in(2)) {
      const double r = s.radius;
      return tell(EllipsoidShape{s.center, {Vec3{r, 0, 0}, {0, r, 0}, {0, 0, r}}});
    }
    if (dice_.one_in(2)) return node_of(s);
    const double back = 1 / s.radius;
    return transformed(node_of(SphereShape{back * s.center, 1}),
                       scaling({s.radius, s.radius, s.radius}));
  }
  CsgNode tell(const EllipsoidShape& e) {
    // The unit sphere is first turned in itself.
    const Affine turn = rotation(dice_.unit_vector(), chains::round_angle(dice_));
    const auto column = [&](std::size_t i) {
      return turn.m[0][i] * e.axes[0] + turn.m[1][i] * e.axes[1] + turn.m[2][i] * e.axes[2];
    };
    return node_of(EllipsoidShape{e.center, {column(0), column(1), column(2)}});
  }
  CsgNode tell(const TorusShape& t) {
    if (across_kinds_ && dice_.one_in(2)) {
      return node_of(EllipticTorusShape{t.center, t.axis, t.major, t.minor, 0, t.minor});
    }
    const double s = dice_.sign() * (dice_.one_in(2) ? 1 : dice_.between(0.3, 3));
    return node_of(TorusShape{t.center, s * t.axis, t.major, t.minor});
  }
  CsgNode tell(const EllipticConeShape& c) {
    switch (dice_.below(3)) {
      case 0: return node_of(EllipticConeShape{c.base, c.top, c.b, c.a, c.top_b, c.top_a});
      case 1: return node_of(EllipticConeShape{c.base, c.top, -c.a, c.b, c.top_a, c.top_b});
      default: return node_of(c);
    }
  }
  CsgNode tell(const EllipticTorusShape& t) {
    if (dice_.one_in(2)) return node_of(t);
    // The torus is seen from the other side of its plane.
    return node_of(EllipticTorusShape{t.center, -t.axis, t.radius, t.outward, -t.upward, t.across});
  }
  template <typename Shape>
  CsgNode tell(const Shape& shape) {
    return node_of(shape);
  }

  Dice& dice_;
  bool across_kinds_;
};

/// A leaf with a rigid map carried out in its numbers; nothing for kinds that can't hold it.
class CarriedOut {
 public:
  explicit CarriedOut(const Affine& map) : map_(map) {}

  std::optional<CsgNode> operator()(const SphereShape& s) const {
    return node_of(SphereShape{map_.point(s.center), s.radius});
  }
  std::optional<CsgNode> operator()(const BoxShape& b) const { return (*this)(polyhedron_of(b)); }
  std::optional<CsgNode> operator()(const CylinderShape& c) const {
    return node_of(CylinderShape{map_.point(c.base), map_.point(c.top), c.radius});
  }
  std::optional<CsgNode> operator()(const ConeShape& c) const {
    return node_of(ConeShape{map_.point(c.base), c.base_radius, map_.point(c.top), c.top_radius});
  }
  std::optional<CsgNode> operator()(const TorusShape& t) const {
    return node_of(TorusShape{map_.point(t.center), map_.vector(t.axis), t.major, t.minor});
  }
  std::optional<CsgNode> operator()(const EllipticTorusShape& t) const {
    return node_of(EllipticTorusShape{map_.point(t.center), map_.vector(t.axis), t.radius,
                                      t.outward, t.upward, t.across});
  }
  std::optional<CsgNode> operator()(const EllipticConeShape& c) const {
    return node_of(EllipticConeShape{map_.point(c.base), map_.point(c.top), map_.vector(c.a),
                                     map_.vector(c.b), c.top_a, c.top_b});
  }
  std::optional<CsgNode> operator()(const EllipsoidShape& e) const {
    return node_of(
        EllipsoidShape{map_.point(e.center),
                       {map_.vector(e.axes[0]), map_.vector(e.axes[1]), map_.vector(e.axes[2])}});
  }
  std::optional<CsgNode> operator()(const HalfSpaceShape& h) const { return node_of(moved(h)); }
  std::optional<CsgNode> operator()(const PolyhedronShape& p) const {
    PolyhedronShape carried;
    for (const HalfSpaceShape& h : p.planes) carried.planes.push_back(moved(h));
    return node_of(std::move(carried));
  }
  std::optional<CsgNode> operator()(const MeshShape& m) const {
    MeshShape carried = m;
    for (Vec3& p : carried.mesh.points) p = map_.point(p);
    return node_of(std::move(carried));
  }
  template <typename Shape>
  std::optional<CsgNode> operator()(const Shape&) const {
    return std::nullopt;
  }

 private:
  HalfSpaceShape moved(const HalfSpaceShape& h) const {
    const Vec3 n = map_.vector(h.normal);
    return {n, h.offset + dot(n, map_.translation())};
  }
  Affine map_;
};

/// The node brought to its place, told in other numbers.
inline CsgNode told_anew(const CsgNode& node, Chain way, Dice& dice, bool across_kinds = false) {
  CsgNode told = Retelling(dice, across_kinds)(node);
  if (!told.transform && !way.empty() && way.front().is_rigid()) {
    const CarriedOut carry(way.front().map());
    if (auto carried = std::visit(carry, told.value)) {
      told = *std::move(carried);
      way.erase(way.begin());
    }
  }
  return placed(std::move(told), way, dice);
}

}  // namespace graycube::testing
