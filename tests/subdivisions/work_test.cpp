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

TEST_CASE("Roth's trees leave an operand out when those before it have decided") {
  // A difference whose left operand the ray misses: what is taken away isn't asked for.
  const auto counts_along = [](const Ray& ray, Operation operation_kind) {
    std::vector<CsgNode> operands{node_of(SphereShape{{0, 0, 0}, 1}),
                                  node_of(SphereShape{{0.5, 0, 0}, 1}),
                                  node_of(SphereShape{{0, 0.5, 0}, 1})};
    const Model model = compile_scene(scene_of({operation(operation_kind, std::move(operands))}));
    Mailbox mailbox;
    make_search(model, {Subdivision::kRoth})->first_crossing(ray, 0, kInf, mailbox);
    return mailbox.counts;
  };
  // Within the box and the sphere of the whole, yet beside the first sphere.
  const Ray beside{{0.95, 0.7, -5}, {0, 0, 1}};
  const WalkCounts difference = counts_along(beside, Operation::kDifference);
  CHECK(difference.primitives_tested == 0);
  const Ray through{{0.2, 0.2, -5}, {0, 0, 1}};
  CHECK(counts_along(through, Operation::kDifference).primitives_tested == 3);
  CHECK(counts_along(through, Operation::kUnion).primitives_tested == 3);
  CHECK(counts_along({{9, 9, -5}, {0, 0, 1}}, Operation::kUnion).spheres_tested == 1);
}
