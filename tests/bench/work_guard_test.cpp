// Guards speed without a clock: work per ray on fixed scenes, which is the same on every machine.
#include <cstdio>
#include <string>

#include "bench/scene_families.hpp"
#include "catch.hpp"
#include "scene/compile_scene.hpp"
#include "trace/render_serial.hpp"

using namespace graycube;
using namespace graycube::bench;

namespace {

struct Guard {
  const char* name;
  Family family;
  std::uint32_t size;
  /// Bounds about a quarter above the last counts. When a change lowers the counts, lower these
  /// too; when it raises them for a reason, tell it in the commit.
  double cells_per_ray, primitives_per_ray;
};
constexpr Guard kGuards[]{
    {"csg 1000", Family::kCsg, 1000, 5.4, 3.7},
    {"csg 10000", Family::kCsg, 10'000, 10.0, 4.8},
    {"spheres 10000", Family::kSpheres, 10'000, 10.7, 3.1},
    {"flake 3", Family::kFlake, 3, 3.4, 2.6},
    {"menger 3", Family::kMenger, 3, 4.3, 5.7},
    {"deepcsg 250", Family::kDeepCsg, 250, 2.6, 18.3},
    {"deepcsg 2000", Family::kDeepCsg, 2000, 4.2, 15.6},
    {"glasslens 3", Family::kGlassLens, 3, 3.1, 4.4},
};
constexpr std::uint64_t kSeed = 1987;
constexpr std::uint32_t kSide = 64;

struct Work {
  double cells_per_ray, primitives_per_ray;
};

Work work_of(Family family, std::uint32_t size, std::uint64_t seed = kSeed) {
  const Domain domain(compile_scene(make_scene(family, size, seed, kSide)));
  Film film(kSide, kSide, 1);
  const SerialResult result = render_serial(domain, {}, film);
  double rays = 0;
  for (const std::uint64_t n : result.rays.created) rays += static_cast<double>(n);
  REQUIRE(rays >= kSide * kSide);
  return {static_cast<double>(result.walk.cells_visited) / rays,
          static_cast<double>(result.walk.primitives_tested) / rays};
}

}  // namespace

TEST_CASE("work per ray stays within its bounds on every family of scenes") {
  for (const Guard& guard : kGuards) {
    const Work work = work_of(guard.family, guard.size);
    std::printf("%-14s cells %7.3f of %7.3f, primitives %7.3f of %7.3f a ray\n", guard.name,
                work.cells_per_ray, guard.cells_per_ray, work.primitives_per_ray,
                guard.primitives_per_ray);
    CAPTURE(std::string(guard.name));
    CHECK(work.cells_per_ray <= guard.cells_per_ray);
    CHECK(work.primitives_per_ray <= guard.primitives_per_ray);
    // Counting nothing would pass every bound.
    CHECK(work.cells_per_ray > 0.1 * guard.cells_per_ray);
    CHECK(work.primitives_per_ray > 0.1 * guard.primitives_per_ray);
  }
}

TEST_CASE("eight times the holes in one solid cost a ray less than twice the work") {
  const Work few = work_of(Family::kDeepCsg, 250);
  const Work many = work_of(Family::kDeepCsg, 2000);
  CHECK(many.cells_per_ray + many.primitives_per_ray <
        2 * (few.cells_per_ray + few.primitives_per_ray));
}

TEST_CASE("a hundred times the spheres cost a ray less than three times the work") {
  const Work few = work_of(Family::kSpheres, 100);
  const Work many = work_of(Family::kSpheres, 10'000);
  CHECK(many.cells_per_ray + many.primitives_per_ray <
        3 * (few.cells_per_ray + few.primitives_per_ray));
}
