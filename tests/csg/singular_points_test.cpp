// Rays through points where a solid's surface has no tangent plane: the tips of cones, ridges of
// wedges, where a double cone, a torus or a lathe meets its axis. Rays come from all sides, begin
// before, behind and far away from the point.
#include <cmath>
#include <sstream>
#include <string>

#include "catch.hpp"
#include "csg/one_primitive.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// A solid whose surface is singular at a point of its own coordinates.
struct Singular {
  CsgNode node;
  Vec3 point;
};

Singular tip_of_cone(Dice& dice) {
  const double height = dice.one_in(2) ? 1 : dice.between(0.2, 4);
  return {node_of(ConeShape{{0, 0, 0}, dice.between(0.1, 3), {0, 0, height}, 0}), {0, 0, height}};
}

/// The ridge in which a cone from an ellipse to a line ends.
Singular ridge(Dice& dice) {
  const double b = dice.between(0.3, 2), top = dice.between(0.1, b);
  EllipticConeShape cone{{0, 0, 0}, {0, 0, 1.5}, {dice.between(0.3, 2), 0, 0}, {0, b, 0}, 0, top};
  return {node_of(cone), {0, dice.one_in(3) ? 0 : dice.between(-0.9, 0.9) * top, 1.5}};
}

/// The tip in which two nappes meet.
Singular tip_of_nappes(Dice& dice) {
  const double steepness = dice.between(0.3, 3);
  return {node_of(QuadricShape{
              {dice.one_in(3) ? 0.0 : 1.0, -steepness, 0, 0}, {-3, -3, -1}, {3, 3, 1}}),
          {0, 0, 0}};
}

/// Where a torus without a hole meets its axis.
Singular dimple(Dice& dice) {
  const double major = dice.between(0.5, 1.5);
  const double minor = dice.one_in(3) ? major : major * dice.between(1, 1.8);
  return {node_of(TorusShape{{0, 0, 0}, {0, 0, 1}, major, minor}),
          {0, 0, dice.sign() * std::sqrt(minor * minor - major * major)}};
}

/// Lathes that end on their axis in a cone's tip, in a cusp or flat.
Singular tip_of_lathe(Dice& dice) {
  const double inner = dice.one_in(3) ? 0 : dice.between(0, 1);
  const double below = dice.one_in(3) ? 1 : dice.between(0, 1);
  OutlineLoop loop{{0, 1},   {inner, below}, {1, 0.5}, {1, 0},  {0.7, 0},
                   {0.3, 0}, {0, 0},         {0, 0.3}, {0, 0.7}};
  return {node_of(LatheShape{{std::move(loop)}}), {0, 0, 1}};
}

constexpr std::size_t kSingularKinds = 5;
Singular singular(std::size_t kind, Dice& dice) {
  switch (kind) {
    case 0: return tip_of_cone(dice);
    case 1: return ridge(dice);
    case 2: return tip_of_nappes(dice);
    case 3: return dimple(dice);
    default: return tip_of_lathe(dice);
  }
}

Affine some_map(Dice& dice) {
  RandomModel random(dice.below(1'000'000));
  return dice.one_in(3) ? Affine{} : random.map();
}

/// A ray through the point or next to it, whose origin is anywhere on its line.
Ray ray_through(const Vec3& point, const Affine& map, Dice& dice) {
  const Vec3 own = dice.one_in(2) ? Vec3{0, 0, dice.sign()} : dice.axis();
  const Vec3 d = normalized(dice.one_in(2) ? dice.unit_vector() : map.vector(own));
  const double back = dice.one_in(8) ? 0 : dice.sign() * std::pow(10, dice.between(-3, 3));
  const double beside = dice.one_in(3) ? 0 : std::pow(10, dice.between(-17, -8));
  return {point + beside * dice.unit_vector() - back * d, d};
}

std::string text_of(const Ray& ray, double t, const Vec3& n) {
  std::ostringstream s;
  s.precision(17);
  const Vec3 &o = ray.origin, &d = ray.direction;
  s << "origin " << o.x << ' ' << o.y << ' ' << o.z << " direction " << d.x << ' ' << d.y << ' '
    << d.z << " t " << t << " normal " << n.x << ' ' << n.y << ' ' << n.z;
  return s.str();
}

}  // namespace

TEST_CASE("a solid has an outward unit normal where its surface has no tangent plane") {
  for (std::size_t kind = 0; kind < kSingularKinds; ++kind) {
    std::size_t ends = 0;
    for (std::uint64_t seed = 0; seed < 4000; ++seed) {
      INFO("kind " << kind << ", seed " << seed);
      Dice dice(seed * kSingularKinds + kind);
      Singular solid = singular(kind, dice);
      const Affine map = some_map(dice);
      const Vec3 point = map.point(solid.point);
      const OnePrimitive one(transformed(std::move(solid.node), map));
      for (int i = 0; i < 10; ++i) {
        const Ray ray = ray_through(point, map, dice);
        const Spans spans = one.spans(ray);
        for (int k = 0; k < 2 * spans.count; ++k) {
          const double t = end_of(spans, k);
          if (length(ray.at(t) - point) > 1e-6) continue;
          const Vec3 n = one.normal(ray, t);
          if (!(std::fabs(length(n) - 1) < 1e-12)) FAIL(text_of(ray, t, n));
          ++ends;
          if (is_touched(spans, k, 1e-6)) continue;
          const double along = dot(n, ray.direction);
          if (k % 2 == 0 ? along > 0.05 : along < -0.05) FAIL(text_of(ray, t, n));
        }
      }
    }
    INFO("kind " << kind);
    CHECK(ends > 1000);
  }
}
