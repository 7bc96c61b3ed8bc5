// Lathes and sweeps against the same outlines as polygons, along random rays.
#include <cmath>
#include <cstdint>

#include "catch.hpp"
#include "outline/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

enum class Kind { kLathe, kSweep };

/// How many outlines; each meets kRaysOfEach rays.
constexpr std::uint64_t kOutlines = 100;
constexpr int kRaysOfEach = 100;

/// Rays that are hard to get right are frequent: level and upright ones, and nearly so; through the
/// axis and along it; through joints; from within; in the plane of a sweep's end.
Ray hard_ray(const Outline& outline, Dice& dice) {
  const OutlineLoop& loop = outline.loops()[dice.below(outline.loops().size())];
  const OutlinePoint joint = loop[3 * dice.below(loop.size() / 3)];
  Vec3 through = dice.point(1);
  switch (dice.below(6)) {
    case 0: through = {joint.x, 0, joint.y}; break;
    case 1: through = {joint.x, joint.y, dice.between(-0.5, 0.5)}; break;
    case 2: through = {0, 0, dice.between(-1, 1)}; break;
    case 3: through = {dice.between(0, 1), dice.between(-1, 1), dice.sign() * 0.5}; break;
    default: break;
  }
  Vec3 d = dice.unit_vector();
  const double tilt = dice.one_in(2) ? 0.0 : std::pow(10, dice.between(-18, -1));
  switch (dice.below(6)) {
    case 0: d = {d.x, d.y, tilt * d.z}; break;
    case 1: d = {tilt * d.x, tilt * d.y, 1}; break;
    case 2: d = {-through.y + tilt * d.x, through.x + tilt * d.y, tilt * d.z}; break;
    case 3: d = {through.x, through.y, d.z}; break;
    default: break;
  }
  if (!(length(d) > 0)) d = {1, 0, 0};
  d = normalized(d);
  return {through - (dice.one_in(3) ? 0.0 : dice.between(-3, 3)) * d, d};
}

/// Membership of points of random rays; returns how many were compared, and counts those inside.
std::size_t compare(Kind kind, std::size_t& inside) {
  std::size_t compared = 0;
  for (std::uint64_t seed = 0; seed < kOutlines; ++seed) {
    Dice dice(seed);
    const Placed placed(random_loops(dice));
    const Polygons polygons(placed.outline().loops());
    for (int i = 0; i < kRaysOfEach; ++i) {
      const Ray ray = hard_ray(placed.outline(), dice);
      const Spans spans = kind == Kind::kLathe ? csg::lathe_spans(placed.place(), ray)
                                               : csg::sweep_spans(placed.place(), ray);
      INFO("seed " << seed << ", ray " << i);
      if (!are_in_order(spans)) FAIL("out of order");
      for (int k = 0; k < 6; ++k) {
        const double t = dice.between(-3, 3);
        const Vec3 p = ray.at(t);
        const double x = kind == Kind::kLathe ? std::hypot(p.x, p.y) : p.x;
        const double y = kind == Kind::kLathe ? p.z : p.y;
        if (!polygons.is_clear(x, y, Polygons::kError)) continue;
        if (kind == Kind::kSweep && std::fabs(std::fabs(p.z) - 0.5) < 1e-9) continue;
        const bool is_inside =
            polygons.contains(x, y) && (kind == Kind::kLathe || std::fabs(p.z) < 0.5);
        if (is_within(spans, t) != is_inside) {
          FAIL("t " << t << " at " << p.x << ' ' << p.y << ' ' << p.z << ", inside: " << is_inside);
        }
        ++compared;
        inside += is_inside ? 1 : 0;
      }
    }
  }
  return compared;
}

}  // namespace

TEST_CASE("a lathe holds what its outline holds, along rays of all kinds") {
  std::size_t inside = 0;
  const std::size_t compared = compare(Kind::kLathe, inside);
  CHECK(compared > kOutlines * kRaysOfEach * 3);
  CHECK(inside > compared / 40);
}

TEST_CASE("a sweep holds what its outline holds, along rays of all kinds") {
  std::size_t inside = 0;
  const std::size_t compared = compare(Kind::kSweep, inside);
  CHECK(compared > kOutlines * kRaysOfEach * 3);
  CHECK(inside > compared / 80);
}

TEST_CASE("points of the outline itself are where rays enter or leave") {
  // Of each end of an interval the point is on the curve: a step along the ray to either side of
  // it is inside on one side only. Grazing rays, which a step takes too far, are left out.
  std::size_t ends = 0, doubtful = 0;
  for (std::uint64_t seed = 0; seed < kOutlines; ++seed) {
    Dice dice(seed + 1000);
    const Placed placed(random_loops(dice));
    for (int i = 0; i < kRaysOfEach; ++i) {
      const Ray ray = hard_ray(placed.outline(), dice);
      const Spans spans = csg::lathe_spans(placed.place(), ray);
      for (int k = 0; k < spans.count; ++k) {
        const auto& s = spans.interval[static_cast<std::size_t>(k)];
        const Vec3 n = csg::lathe_normal(placed.place(), ray, s.enter);
        const double steep = std::fabs(dot(n, ray.direction));
        if (!(std::fabs(length(n) - 1) < 1e-12)) FAIL("seed " << seed << ", ray " << i);
        const double before = k > 0 ? spans.interval[static_cast<std::size_t>(k - 1)].leave : -kInf;
        if (s.leave - s.enter < 1e-5 || s.enter - before < 1e-5 || steep < 1e-2) continue;
        ++ends;
        constexpr double kStep = 1e-11;
        if (!csg::lathe_contains(placed.place(), ray.at(s.enter + kStep)) ||
            csg::lathe_contains(placed.place(), ray.at(s.enter - kStep)))
          ++doubtful;
      }
    }
  }
  CHECK(ends > kOutlines * 30);
  // Where a ray goes through a corner, a step to its side may miss it.
  CHECK(doubtful * 1000 < ends);
}
