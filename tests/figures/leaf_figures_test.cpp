// Figures of leaf regions show what the BSP has.
#include <algorithm>

#include "catch.hpp"
#include "figures/bsp_figure.hpp"
#include "figures/entry_figure.hpp"
#include "figures/pointers_figure.hpp"
#include "figures/screen_regions.hpp"
#include "figures/well_formed.hpp"
#include "frontal/preparation/preparation.hpp"
#include "simulation/pictures.hpp"
#include "subdivisions/frustum_order.hpp"
#include "subdivisions/linked_walk.hpp"

namespace graycube::figures {
namespace {

using testing::xml_problem;

Model some_model() { return compile_scene(*read_scene_text(simulation::scene_text(48, 32)).scene); }
Picture grey_picture() { return {48, 32, std::vector<float>(48 * 32 * 3, 0.5f), {}, {}}; }

TEST_CASE("the pointers drawn are those of the BSP, through the faces that the section shows") {
  const Model model = some_model();
  for (const Subdivision way : {Subdivision::kLinked, Subdivision::kArnaldi}) {
    const LeafSpace space(model, way);
    const PointersShown shown = choose_pointers(space);
    REQUIRE_FALSE(shown.leaves.empty());
    std::size_t pointers = 0;
    for (const std::uint32_t node : shown.leaves) {
      REQUIRE(space.bsp().nodes()[node].axis == BspNode::kLeafAxis);
      const BspLeaf& leaf = space.bsp().leaves()[space.bsp().nodes()[node].child];
      for (const Pointer& p : pointers_of(space, shown.section, node)) {
        const int axis = p.face < 2 ? shown.section.right : shown.section.up;
        CHECK(p.target == leaf.neighbour[static_cast<std::size_t>(axis * 2 + p.face % 2)]);
        // What it points at lies beyond the face.
        const Aabb& target = space.cell(p.target);
        CHECK((p.face % 2 == 0 ? target.hi[axis] == leaf.cell.lo[axis]
                               : target.lo[axis] == leaf.cell.hi[axis]));
        ++pointers;
      }
    }
    const std::string svg = pointers_svg("s.json", space);
    CHECK(xml_problem(svg).empty());
    // An arrow has a path with a curve; the legend has one more.
    CHECK(testing::count(svg, "Q") == pointers + 1);
  }
}

TEST_CASE("regions of the screen cover the picture once, and hold what their leaf regions hold") {
  const Model model = some_model();
  const LeafSpace space(model, Subdivision::kArnaldi);
  const auto regions = screen_regions_of(space);
  double area = 0;
  std::uint32_t leaves = 0;
  for (const ScreenRegion& r : regions) {
    const double width = std::min(r.x1, 48.0) - std::max(r.x0, 0.0);
    const double height = std::min(r.y1, 32.0) - std::max(r.y0, 0.0);
    if (width > 0 && height > 0) area += width * height;
    leaves += r.leaves;
    CHECK(r.primitives == space.primitives_below(r.node).size());
  }
  CHECK(area == Approx(48.0 * 32.0));
  CHECK(leaves == space.bsp().leaves().size());
  CHECK(regions.size() > 3);
  CHECK(xml_problem(bsp_svg("s.json", grey_picture(), space)).empty());
  CHECK(xml_problem(bsp_svg("s.json", grey_picture(), LeafSpace(model, Subdivision::kLinked)))
            .empty());
}

TEST_CASE("a received ray's way goes by links to the leaf region that a descent finds") {
  control::JobOptions options;
  options.algorithm = Algorithm::kMacro;
  options.partition = PartitionMode::kRegular;
  options.shadows = ShadowMode::kForward;
  const std::string text = simulation::scene_text(48, 32);
  const RunRecord run = record_run(text, options, 4);
  const auto bytes = std::as_bytes(std::span(text.data(), text.size()));
  PreparationWork work;
  work.scene = Bytes(bytes.begin(), bytes.end());
  work.options = options;
  work.cube = *Hypercube::of_size(4);
  const auto prepared = prepare(work, [] { return 0.0; });
  REQUIRE(prepared.scene);
  for (const Subdivision way : {Subdivision::kLinked, Subdivision::kArnaldi}) {
    const auto entry = choose_entry(run, prepared.scene->slices, way);
    REQUIRE(entry);
    const LeafSpace& space = *entry->space;
    const RayTask& ray = entry->received.ray;
    CHECK(ray.t > 0);
    CHECK(entry->way.size() > 1);
    WalkCounts counts;
    const BspLeaf& expected =
        way == Subdivision::kLinked
            ? leaf_at(space.bsp(), 0, PlaneOrder(ray.ray), ray.t, counts)
            : leaf_at(space.bsp(), 0, FrustumOrder(space.camera_space(), ray.ray), ray.t, counts);
    CHECK(&space.bsp().leaves()[space.bsp().nodes()[entry->way.back()].child] == &expected);
    // Each step leads into a subtree that a face of the one before points at.
    for (std::size_t i = 1; i < entry->way.size(); ++i) {
      const BspLeaf& before = space.bsp().leaves()[space.bsp().nodes()[entry->way[i - 1]].child];
      const Aabb& next = space.cell(entry->way[i]);
      const std::uint32_t subtree = subtree_between(space, entry->way[i - 1], entry->way[i]);
      CHECK(std::count(before.neighbour.begin(), before.neighbour.end(), subtree) > 0);
      CHECK(intersection_of(space.cell(subtree), next) == next);
    }
    CHECK(xml_problem(entry_svg("s.json", *entry)).empty());
  }
}

}  // namespace
}  // namespace graycube::figures
