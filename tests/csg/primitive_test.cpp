// Properties that every kind of primitive has, checked on random ones.
#include "csg/primitive.hpp"

#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "catch.hpp"
#include "csg/kinds.hpp"
#include "csg/one_primitive.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint64_t kSeeds = 600;

/// Calls `check(one, dice)` for random primitives of every kind; the seed is shown when something
/// fails.
template <typename Check>
void for_random_primitives(const Check& check, const RandomOptions& options = {}) {
  for (std::size_t kind = 0; kind < kLeafKinds; ++kind) {
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      INFO(kLeafNames[kind] << ", seed " << seed);
      const OnePrimitive one = random_primitive(seed, kind, options);
      Dice dice(seed + 77);
      check(one, dice);
    }
  }
}

/// A point inside; or anywhere, if none is found soon.
Vec3 point_inside(const OnePrimitive& one, Dice& dice) {
  for (int i = 0; i < 5; ++i) {
    const Ray ray = ray_towards(one, dice);
    const Spans spans = one.spans(ray);
    if (spans.count == 0) continue;
    const auto [enter, leave] = spans.interval[0];
    return ray.at(dice.between(std::fmax(enter, -9), std::fmin(leave, 9)));
  }
  return dice.point(3);
}

std::string text_of(const Ray& ray, double t) {
  std::ostringstream s;
  s.precision(17);
  s << "origin " << ray.origin.x << ' ' << ray.origin.y << ' ' << ray.origin.z << " direction "
    << ray.direction.x << ' ' << ray.direction.y << ' ' << ray.direction.z << " t " << t;
  return s.str();
}

}  // namespace

TEST_CASE("intervals are ordered, disjoint, without NaN and without negative zeros") {
  for_random_primitives([](const OnePrimitive& one, Dice& dice) {
    for (int i = 0; i < 40; ++i) {
      const Spans spans = one.spans(ray_towards(one, dice));
      double last = -kInf;
      for (int k = 0; k < spans.count; ++k) {
        const auto [enter, leave] = spans.interval[static_cast<std::size_t>(k)];
        const bool fine = enter >= last && leave >= enter && !(enter == 0 && std::signbit(enter)) &&
                          !(leave == 0 && std::signbit(leave));
        if (!fine) FAIL("[" << enter << ", " << leave << "] after " << last);
        last = leave;
      }
    }
  });
}

TEST_CASE("only kinds that say so are on a line twice") {
  std::array<int, kPrimitiveKinds> twice{};
  for_random_primitives([&](const OnePrimitive& one, Dice& dice) {
    for (int i = 0; i < 40; ++i) {
      if (one.spans(ray_towards(one, dice)).count > 1)
        ++twice[static_cast<std::size_t>(one.primitive().kind)];
    }
  });
  for (const csg::KindTraits& kind : csg::kKinds) {
    INFO(kind.name);
    if (!kind.has_two_intervals) CHECK(twice[static_cast<std::size_t>(kind.kind)] == 0);
  }
  CHECK(twice[static_cast<std::size_t>(PrimitiveKind::kTorus)] > 0);
}

TEST_CASE("a point of a ray is inside exactly when its parameter is in an interval") {
  std::size_t inside = 0, compared = 0;
  for_random_primitives([&](const OnePrimitive& one, Dice& dice) {
    for (int i = 0; i < 40; ++i) {
      const Ray ray = ray_towards(one, dice);
      const Spans spans = one.spans(ray);
      for (int k = 0; k < 12; ++k) {
        const double t = dice.between(-12, 12);
        const Vec3 p = ray.at(t);
        if (distance_to_ends(spans, t) < 1e-6 || !one.is_clear(p, 1e-7)) continue;
        ++compared;
        inside += one.holds(p) ? 1 : 0;
        if (one.holds(p) != is_inside(spans, t)) FAIL(text_of(ray, t));
      }
    }
  });
  CHECK(compared > kSeeds * kLeafKinds * 400);
  CHECK(inside > compared / 20);
}

TEST_CASE("membership of a line reversed is the same") {
  for_random_primitives([](const OnePrimitive& one, Dice& dice) {
    for (int i = 0; i < 30; ++i) {
      const Ray ray = ray_towards(one, dice);
      const Spans forward = one.spans(ray), backward = one.spans({ray.origin, -ray.direction});
      for (int k = 0; k < 5; ++k) {
        const double t = dice.between(-12, 12);
        if (distance_to_ends(forward, t) < 1e-6 || distance_to_ends(backward, -t) < 1e-6) continue;
        if (is_inside(forward, t) != is_inside(backward, -t)) FAIL(text_of(ray, t));
      }
    }
  });
}

TEST_CASE("parameters count in lengths of the direction") {
  for_random_primitives([](const OnePrimitive& one, Dice& dice) {
    for (int i = 0; i < 20; ++i) {
      const Ray ray = ray_towards(one, dice);
      const Spans a = one.spans(ray), b = one.spans({ray.origin, 4.0 * ray.direction});
      for (int k = 0; k < 5; ++k) {
        const double t = dice.between(-12, 12);
        if (distance_to_ends(a, t) < 1e-6 || distance_to_ends(b, t / 4) < 1e-6) continue;
        if (is_inside(a, t) != is_inside(b, t / 4)) FAIL(text_of(ray, t));
      }
    }
  });
}

TEST_CASE("bounds enclose every point of the surface") {
  std::size_t ends = 0;
  for_random_primitives([&](const OnePrimitive& one, Dice& dice) {
    for (int i = 0; i < 40; ++i) {
      const Ray ray = ray_towards(one, dice);
      const Spans spans = one.spans(ray);
      for (int k = 0; k < spans.count; ++k) {
        const auto [enter, leave] = spans.interval[static_cast<std::size_t>(k)];
        for (const double t : {enter, leave}) {
          if (!std::isfinite(t) || std::fabs(t) > 1e4) continue;
          ++ends;
          if (!one.bounds().contains(ray.at(t)) && !one.bounds().grown(1e-11).contains(ray.at(t))) {
            FAIL(text_of(ray, t));
          }
        }
      }
    }
  });
  CHECK(ends > kSeeds * kLeafKinds * 30);
}

TEST_CASE("bounds enclose every point inside, however far") {
  for_random_primitives([](const OnePrimitive& one, Dice& dice) {
    for (int i = 0; i < 200; ++i) {
      const Vec3 p = std::pow(10, dice.between(-1, 6)) * dice.unit_vector();
      if (one.holds(p) && !one.bounds().grown(1e-11).contains(p)) {
        FAIL(p.x << ' ' << p.y << ' ' << p.z);
      }
    }
  });
}

TEST_CASE("bounds of a polyhedron of thousands of faces are those of its corners") {
  // Faces that touch an ellipsoid: the polyhedron holds it, and is hardly larger.
  Dice dice(5);
  const Vec3 axes{3, 1, 0.5};
  std::vector<Plane> faces;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 n = dice.unit_vector();
    const Vec3 scaled{axes.x * n.x, axes.y * n.y, axes.z * n.z};
    faces.push_back({n, length(scaled)});
  }
  const Aabb b = csg::polyhedron_bounds(faces);
  for (int a = 0; a < 3; ++a) {
    CHECK(b.hi[a] >= axes[a]);
    CHECK(b.hi[a] <= 1.01 * axes[a]);
    CHECK(b.lo[a] <= -axes[a]);
    CHECK(b.lo[a] >= -1.01 * axes[a]);
  }
  // Faces on one side alone bound nothing.
  std::erase_if(faces, [](const Plane& f) { return f.normal.z > 0; });
  CHECK(csg::polyhedron_bounds(faces).hi.z == kInf);
}

TEST_CASE("bounds are tight around bounded solids") {
  // The polyhedra's planes may cut a box without reaching its bounds' corners, but every side is
  // touched.
  for_random_primitives(
      [](const OnePrimitive& one, Dice& dice) {
        const Aabb b = one.bounds();
        if (!b.is_finite()) return;
        // The extreme of the surface along an axis, by many rays across it.
        for (int a = 0; a < 3; ++a) {
          double most = -kInf;
          for (int i = 0; i < 900; ++i) {
            Ray ray;
            ray.direction[a] = 1;
            for (int other = 0; other < 3; ++other) {
              if (other != a) ray.origin[other] = dice.between(b.lo[other], b.hi[other]);
            }
            const Spans spans = one.spans(ray);
            for (int k = 0; k < spans.count; ++k) {
              most = std::fmax(most, spans.interval[static_cast<std::size_t>(k)].leave);
            }
          }
          const double missing = (b.hi[a] - most) / (b.hi[a] - b.lo[a]);
          if (!(missing < 0.35)) FAIL("axis " << a << ": " << missing << " of the width is empty");
        }
      },
      {.coincidences = true, .unbounded = false, .max_objects = 1, .max_tree_depth = 1});
}

TEST_CASE("outward normals are unit and point outwards") {
  std::size_t ends = 0, doubtful = 0;
  for_random_primitives([&](const OnePrimitive& one, Dice& dice) {
    constexpr double kStep = 1e-6;
    for (int i = 0; i < 40; ++i) {
      const Ray ray = ray_towards(one, dice);
      const Spans spans = one.spans(ray);
      for (int k = 0; k < 2 * spans.count; ++k) {
        const double t = end_of(spans, k);
        if (!std::isfinite(t) || std::fabs(t) > 100) continue;
        ++ends;
        const Vec3 n = one.normal(ray, t);
        if (!(std::fabs(length(n) - 1) < 1e-12)) FAIL(text_of(ray, t) << " length " << length(n));
        if (is_touched(spans, k, 1e-7)) continue;
        // Entering, the ray runs against the normal, but for rounding in grazing.
        const double along = dot(n, ray.direction);
        if (k % 2 == 0 ? along > 1e-5 : along < -1e-5) FAIL(text_of(ray, t));
        // The half-space behind the normal is inside, in all directions: an edge may be near.
        const Vec3 p = ray.at(t);
        const Vec3 u = normalized(cross(n, std::fabs(n.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
        const Vec3 v = cross(n, u);
        bool agrees = true;
        for (const Vec3& side : {Vec3{}, u, v, -u, -v}) {
          agrees = agrees && one.holds(p + kStep * (2 * side - n)) &&
                   !one.holds(p + kStep * (2 * side + n));
        }
        doubtful += agrees ? 0 : 1;
      }
    }
  });
  INFO(doubtful << " of " << ends);
  CHECK(ends > kSeeds * kLeafKinds * 30);
  CHECK(doubtful * 1000 < ends);
}

TEST_CASE("a cell that counts as outside or inside is so with every point") {
  for (std::size_t kind = 0; kind < kLeafKinds; ++kind) {
    std::size_t outside = 0, inside = 0, crosses = 0;
    for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
      INFO(kLeafNames[kind] << ", seed " << seed);
      const OnePrimitive one = random_primitive(seed, kind);
      Dice dice(seed);
      for (int i = 0; i < 120; ++i) {
        const Vec3 middle = dice.one_in(2)   ? point_inside(one, dice)
                            : dice.one_in(2) ? dice.grid_point(3)
                                             : dice.point(3);
        const double size = std::pow(10, dice.between(-3, 1));
        const Vec3 half{size * dice.unit(), size * dice.unit(), size * dice.unit()};
        Aabb cell{middle - half, middle + half};
        if (dice.one_in(4)) cell.lo[static_cast<int>(dice.below(3))] = -kInf;
        if (dice.one_in(4)) cell.hi[static_cast<int>(dice.below(3))] = kInf;
        const CellSide side = one.side(cell.grown(one.model.delta));
        (side == CellSide::kOutside ? outside : side == CellSide::kInside ? inside : crosses) += 1;
        if (side == CellSide::kCrosses) continue;
        for (int k = 0; k < 30; ++k) {
          Vec3 p;
          for (int a = 0; a < 3; ++a) {
            const double reach = std::pow(10, dice.between(0, 5));
            p[a] = dice.one_in(4) && std::isfinite(cell.lo[a]) ? cell.lo[a]
                   : dice.one_in(4) && std::isfinite(cell.hi[a])
                       ? cell.hi[a]
                       : dice.between(
                             std::fmax(cell.lo[a], std::fmin(cell.hi[a], reach) - 2 * reach),
                             std::fmin(cell.hi[a], std::fmax(cell.lo[a], -reach) + 2 * reach));
          }
          if (one.holds(p) != (side == CellSide::kInside)) FAIL(p.x << ' ' << p.y << ' ' << p.z);
        }
      }
    }
    INFO(kLeafNames[kind] << ": " << outside << " outside, " << inside << " inside, " << crosses
                          << " cross");
    CHECK(outside > kSeeds * 10);
    CHECK(inside > kSeeds);
    CHECK(crosses > kSeeds * 10);
  }
}
