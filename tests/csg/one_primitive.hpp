// Single primitives for the tests: made by kind from a seed, with the faces that polyhedra keep
// elsewhere.
#pragma once

#include <array>
#include <cmath>

#include "csg/random_model.hpp"

namespace graycube::testing {

inline const std::array<const char*, kLeafKinds> kLeafNames{
    "sphere",    "box",        "cylinder",      "cone",           "torus",
    "ellipsoid", "polyhedron", "elliptic_cone", "elliptic_torus", "quadric",
    "mesh",      "lathe",      "sweep",         "bezier",         "half_space"};

struct OnePrimitive {
  Model model;

  explicit OnePrimitive(CsgNode leaf) : model(compile_scene(scene_of({std::move(leaf)}))) {}

  const Primitive& primitive() const { return model.primitives.front(); }
  const Aabb& bounds() const { return primitive().bounds; }
  Spans spans(const Ray& ray) const { return spans_along(primitive(), model.data(), ray); }
  bool holds(const Vec3& p) const { return contains(primitive(), model.data(), p); }
  Vec3 normal(const Ray& ray, double t) const {
    return outward_normal(primitive(), model.data(), ray, t);
  }
  CellSide side(const Aabb& cell) const { return classify(primitive(), model.data(), cell); }

  /// Do all points of a small ball around p agree on membership?
  bool is_clear(const Vec3& p, double radius) const {
    const bool inside = holds(p);
    for (int i = 0; i < 27; ++i) {
      const Vec3 d{i % 3 - 1.0, i / 3 % 3 - 1.0, i / 9 - 1.0};
      if (holds(p + radius * d) != inside) return false;
    }
    return true;
  }
};

/// A primitive of a kind, in most cases under a random map.
inline OnePrimitive random_primitive(std::uint64_t seed, std::size_t kind,
                                     const RandomOptions& options = {}) {
  RandomModel random(seed * kLeafKinds + kind, options);
  CsgNode leaf = random.leaf(kind);
  if (!random.dice().one_in(3)) leaf = transformed(std::move(leaf), random.map());
  return OnePrimitive(std::move(leaf));
}

/// A ray that has a good chance to meet the primitive.
inline Ray ray_towards(const OnePrimitive& one, Dice& dice) {
  const Vec3 from = dice.one_in(4) ? dice.grid_point(4) : dice.point(6);
  const Aabb b = intersection_of(one.bounds(), {{-4, -4, -4}, {4, 4, 4}});
  Vec3 to = dice.point(2);
  if (!b.is_empty()) {
    for (int a = 0; a < 3; ++a) to[a] = dice.between(b.lo[a], b.hi[a]);
  }
  if (dice.one_in(8)) return {from, dice.axis()};
  return {from, normalized(to - from)};
}

inline bool is_inside(const Spans& spans, double t) {
  for (int i = 0; i < spans.count; ++i) {
    const auto& s = spans.interval[static_cast<std::size_t>(i)];
    if (t >= s.enter && t <= s.leave) return true;
  }
  return false;
}
/// End number k: where an interval begins, then where it ends.
inline double end_of(const Spans& spans, int k) {
  const auto& s = spans.interval[static_cast<std::size_t>(k / 2)];
  return k % 2 == 0 ? s.enter : s.leave;
}
/// Whether the line is at end k for an instant only, in the solid or outside of it: it touches the
/// surface there, and no direction is outwards.
inline bool is_touched(const Spans& spans, int k, double tolerance) {
  const double t = end_of(spans, k);
  const auto is_near = [&](int other) {
    return other >= 0 && other < 2 * spans.count &&
           std::fabs(end_of(spans, other) - t) <= tolerance;
  };
  return is_near(k - 1) || is_near(k + 1);
}
/// The distance of t from the nearest end.
inline double distance_to_ends(const Spans& spans, double t) {
  double least = kInf;
  for (int i = 0; i < spans.count; ++i) {
    const auto& s = spans.interval[static_cast<std::size_t>(i)];
    least = std::fmin(least, std::fmin(std::fabs(t - s.enter), std::fabs(t - s.leave)));
  }
  return least;
}

}  // namespace graycube::testing
