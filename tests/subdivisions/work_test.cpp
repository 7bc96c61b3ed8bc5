// How much work the ways of finding crossings take, counted.
#include <map>
#include <string>

#include "catch.hpp"
#include "crossings/against_whole_trees.hpp"
#include "subdivisions/searches.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Small spheres all over a cube, seen from a corner.
Model many_spheres(std::size_t count) {
  Dice dice(7);
  std::vector<CsgNode> spheres;
  for (std::size_t i = 0; i < count; ++i) {
    spheres.push_back(node_of(SphereShape{dice.point(10), dice.between(0.1, 0.3)}));
  }
  Scene scene = scene_of(std::move(spheres));
  scene.settings.camera.projection = Projection::kPerspective;
  scene.settings.camera.fov_degrees = 50;
  scene.settings.camera.eye = {20, 14, -25};
  return compile_scene(scene);
}

WalkCounts work_of(const Model& model, const SubdivisionChoice& choice, std::size_t rays) {
  const auto search = make_search(model, choice);
  Mailbox mailbox;
  Dice dice(8);
  for (std::size_t i = 0; i < rays; ++i) {
    search->first_crossing({dice.point(10), dice.unit_vector()}, 0, kInf, mailbox);
  }
  return mailbox.counts;
}

std::uint64_t tests_in(const WalkCounts& work) {
  return work.primitives_tested + work.boxes_tested + work.spheres_tested;
}

}  // namespace

TEST_CASE(
    "a subdivision of 1000 primitives tests far fewer of them and of their bounds than Roth") {
  constexpr std::size_t kRays = 500;
  const Model model = many_spheres(1000);
  const WalkCounts roth = work_of(model, {Subdivision::kRoth}, kRays);
  CHECK(roth.spheres_tested > 600 * kRays);
  CHECK(roth.spheres_rejected <= roth.spheres_tested);
  CHECK(roth.boxes_rejected <= roth.boxes_tested);
  CHECK(roth.boxes_tested == roth.spheres_tested - roth.spheres_rejected);
  CHECK(roth.primitives_tested == roth.boxes_tested - roth.boxes_rejected);
  CHECK(roth.cells_visited == 0);
  CHECK(roth.tests_saved == 0);
  for (const NamedChoice& way : kAllSearches) {
    if (way.choice.way == Subdivision::kRoth) continue;
    INFO(way.name);
    const WalkCounts work = work_of(model, way.choice, kRays);
    CHECK(tests_in(work) * 20 < tests_in(roth));
    CHECK(work.cells_visited > kRays);
    CHECK(work.cells_visited < 100 * kRays);
    CHECK(work.boxes_tested + work.spheres_tested == 0);
    CHECK((work.entry_links > 0) ==
          (has_links(way.choice.way) && entry_of(way.choice) == Entry::kExtremal));
  }
}

TEST_CASE("a primitive that reaches into many leaf regions is tested once a ray") {
  // Slanting rods among small spheres: a ray beside a rod is in one leaf region of it after the
  // other. So few primitives all have a place of their own in the mailbox.
  Dice dice(3);
  std::vector<CsgNode> solids;
  for (int i = 0; i < 60; ++i) solids.push_back(node_of(SphereShape{dice.point(4), 0.2}));
  for (int i = 0; i < 20; ++i) {
    const Vec3 p = dice.point(4);
    solids.push_back(node_of(CylinderShape{p - Vec3{5, 5, 5}, p + Vec3{5, 5, 5}, 0.1}));
  }
  const Model model = compile_scene(scene_of(std::move(solids)));
  for (const NamedChoice& way : kAllSearches) {
    if (way.choice.way == Subdivision::kRoth) continue;
    INFO(way.name);
    const auto search = make_search(model, way.choice);
    Mailbox mailbox;
    std::uint64_t before = 0;
    for (int i = 0; i < 300; ++i) {
      search->first_crossing({dice.point(4) - Vec3{5, 5, 5}, normalized(Vec3{1, 1, 1})}, 0, kInf,
                             mailbox);
      CHECK(mailbox.counts.primitives_tested - before <= model.primitives.size());
      before = mailbox.counts.primitives_tested;
    }
    CHECK(mailbox.counts.tests_saved > 0);
  }
}

TEST_CASE("surfaces that are close together everywhere don't fill the memory") {
  // Spheres about one point: however small a cell is, many of them pass through it.
  constexpr std::size_t kSpheres = 300;
  std::vector<CsgNode> spheres;
  for (std::size_t i = 0; i < kSpheres; ++i) {
    spheres.push_back(node_of(SphereShape{{0, 0, 0}, 1 + 0.01 * static_cast<double>(i)}));
  }
  const Model model = compile_scene(scene_of(std::move(spheres)));
  for (const NamedChoice& way : kAllSearches) {
    INFO(way.name);
    CHECK(make_search(model, way.choice)->memory_bytes() < 40'000 * kSpheres);
  }
}

TEST_CASE("Roth's trees leave an operand out when those before it have decided") {
  // A rod from corner to corner, of which the ray meets the box and the sphere alone, and a ball,
  // which it goes through.
  const auto tests_along = [](const Ray& ray, Operation kind) {
    const Model model = compile_scene(
        scene_of({operation(kind, {node_of(CylinderShape{{-1, -1, -1}, {1, 1, 1}, 0.1}),
                                   node_of(SphereShape{{0.8, -0.8, 0}, 0.5})})}));
    Mailbox mailbox;
    make_search(model, {Subdivision::kRoth})->first_crossing(ray, 0, kInf, mailbox);
    return mailbox.counts.primitives_tested;
  };
  const Ray beside_rod{{0.8, -0.8, -5}, {0, 0, 1}};
  CHECK(tests_along(beside_rod, Operation::kDifference) == 1);
  CHECK(tests_along(beside_rod, Operation::kUnion) == 2);
  const Ray through_rod{{0.7, -0.7, -5}, normalized(Vec3{-0.7, 0.7, 5})};
  CHECK(tests_along(through_rod, Operation::kDifference) == 1);
  // A ball that misses the ray is told by its sphere.
  CHECK(tests_along({{9, 9, -5}, {0, 0, 1}}, Operation::kUnion) == 0);
}
