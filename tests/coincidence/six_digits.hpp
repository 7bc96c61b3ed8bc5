// Rounds numbers as a file of few digits has them.
#pragma once

#include <cstdio>
#include <cstdlib>

#include "coincidence/pair_maker.hpp"

namespace graycube::testing {

inline double rounded_to_six_digits(double v) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", v);
  return std::strtod(text.data(), nullptr);
}

/// Rounds all numbers of nodes: those of shapes, and each level's matrix.
class SixDigits {
 public:
  void operator()(CsgNode& node) {
    if (node.transform) {
      Affine map = *node.transform;
      round(map);
      node.transform = map;
    }
    std::visit([&](auto& shape) { round(shape); }, node.value);
  }

 private:
  static void round(double& v) { v = rounded_to_six_digits(v); }
  static void round(Vec3& v) {
    for (int i = 0; i < 3; ++i) round(v[i]);
  }
  static void round(Affine& map) {
    for (auto& row : map.m) {
      for (double& v : row) round(v);
    }
  }
  void round(OperationNode& o) {
    for (CsgNode& child : o.children) (*this)(child);
  }
  void round(RepeatNode& r) {
    (*this)(r.child.front());
    for (Affine& map : r.maps) round(map);
  }
  static void round(BezierShape& b) {
    for (Vec3& p : b.net.points) round(p);
  }
  static void round(OutlineLoops& outline) {
    for (OutlineLoop& loop : outline) {
      for (OutlinePoint& p : loop) {
        round(p.x);
        round(p.y);
      }
    }
  }
  static void round(LatheShape& l) { round(l.outline); }
  static void round(SweepShape& s) {
    round(s.outline);
    round(s.height);
    round(s.base);
  }
  static void round(ReferenceNode&) {}
  static void round(SphereShape& s) {
    round(s.center);
    round(s.radius);
  }
  static void round(BoxShape& b) {
    round(b.min);
    round(b.max);
  }
  static void round(CylinderShape& c) {
    round(c.base);
    round(c.top);
    round(c.radius);
  }
  static void round(ConeShape& c) {
    round(c.base);
    round(c.base_radius);
    round(c.top);
    round(c.top_radius);
  }
  static void round(TorusShape& t) {
    round(t.center);
    round(t.axis);
    round(t.major);
    round(t.minor);
  }
  static void round(HalfSpaceShape& h) {
    round(h.normal);
    round(h.offset);
  }
  static void round(EllipsoidShape& e) {
    round(e.center);
    for (Vec3& a : e.axes) round(a);
  }
  static void round(PolyhedronShape& p) {
    for (HalfSpaceShape& h : p.planes) round(h);
  }
  static void round(EllipticConeShape& c) {
    for (Vec3* v : {&c.base, &c.top, &c.a, &c.b}) round(*v);
    round(c.top_a);
    round(c.top_b);
  }
  static void round(EllipticTorusShape& t) {
    round(t.center);
    round(t.axis);
    for (double* v : {&t.radius, &t.outward, &t.upward, &t.across}) round(*v);
  }
  static void round(QuadricShape& q) {
    for (double& v : q.coefficients) round(v);
    round(q.min);
    round(q.max);
  }
  static void round(PrismShape& p) {
    for (FlatPoint& c : p.points) {
      round(c.x);
      round(c.y);
    }
    round(p.height);
    round(p.base);
  }
  static void round(MeshShape& m) {
    for (Vec3& p : m.mesh.points) round(p);
    say_six(m);
  }

  /// Sets the digits of a shape or scene that keeps them.
  template <typename T>
  static void say_six(T& owner) {
    if constexpr (requires { owner.digits; }) owner.digits = 6;
  }
  friend void round_to_six_digits(Scene& scene);
};

/// Rounds all of a scene's numbers but its settings', and sets its digits.
inline void round_to_six_digits(Scene& scene) {
  SixDigits rounding;
  for (NamedShape& s : scene.shapes) rounding(s.node);
  for (SceneObject& o : scene.objects) rounding(o.csg);
  SixDigits::say_six(scene);
}

/// A leaf as OpenSCAD tells it: at the origin, with a size, and brought to its place by a level of
/// its own.
class AsOpenscad {
 public:
  CsgNode operator()(const CsgNode& node) const {
    CsgNode told = std::visit([&](const auto& shape) { return tell(shape); }, node.value);
    if (!node.transform) return told;
    return with_level(std::move(told), *node.transform);
  }
  static CsgNode with_level(CsgNode node, const Affine& map) {
    if (node.transform) node = operation(Operation::kUnion, {std::move(node)});
    node.transform = map;
    return node;
  }

 private:
  CsgNode tell(const OperationNode& o) const {
    OperationNode told{o.operation, {}};
    for (const CsgNode& child : o.children) told.children.push_back((*this)(child));
    return node_of(std::move(told));
  }
  static CsgNode tell(const BoxShape& b) {
    return with_level(node_of(BoxShape{{}, b.max - b.min}), translation(b.min));
  }
  static CsgNode tell(const CylinderShape& c) {
    return with_level(node_of(CylinderShape{{}, c.top - c.base, c.radius}), translation(c.base));
  }
  static CsgNode tell(const ConeShape& c) {
    return with_level(node_of(ConeShape{{}, c.base_radius, c.top - c.base, c.top_radius}),
                      translation(c.base));
  }
  static CsgNode tell(const SphereShape& s) {
    return with_level(node_of(SphereShape{{}, s.radius}), translation(s.center));
  }
  static CsgNode tell(const PrismShape& p) {
    PrismShape told = p;
    told.base = 0;
    return with_level(node_of(std::move(told)), translation({0, 0, p.base}));
  }
  template <typename Shape>
  static CsgNode tell(const Shape& shape) {
    return node_of(shape);
  }
};

/// Makes each move a level of the tree.
inline CsgNode on_own_levels(CsgNode node, const Chain& chain) {
  for (const Move& m : chain) node = AsOpenscad::with_level(std::move(node), m.map());
  return node;
}

}  // namespace graycube::testing
