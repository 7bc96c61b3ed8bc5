// Which nodes get copies of their neighbours' slices, and when.
#include <catch2/catch.hpp>

#include "frontal/prepared.hpp"
#include "frontal/render_job.hpp"
#include "trace/corner_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

const Hypercube kCube = *Hypercube::of_size(4);

/// A job whose slices are that long; only their sizes matter here.
RenderJob job_with_slices(const std::vector<std::size_t>& bytes, const control::JobOptions& options = {}) {
  Scene scene = corner_scene();
  scene.settings.image = {256, 256, 1};
  PreparedScene cut = prepared(scene, options);
  for (std::size_t i = 0; i < bytes.size(); ++i) cut.slices[i].resize(bytes[i]);
  // A window for all tiles.
  return RenderJob(1, std::move(cut), kCube, 100, {.window_tiles = 1000});
}

/// Hands out all tiles of a node.
void empty(RenderJob& job, Rank rank) {
  while (!job.next_tiles(rank).empty()) {}
}

}  // namespace

TEST_CASE("a node with nothing left gets a copy of the neighbour that has most, and then its tiles") {
  RenderJob job = job_with_slices({1000, 1000, 1000, 1000});
  const Rank helper{0};
  CHECK_FALSE(job.next_copy(helper));
  empty(job, helper);
  const auto owner = job.next_copy(helper);
  REQUIRE(owner);
  CHECK(kCube.link_between(helper, *owner));
  CHECK_FALSE(job.next_copy(helper));
  CHECK(job.next_tiles(helper).empty());
  job.set_copied(helper, *owner);
  const auto tiles = job.next_tiles(helper);
  REQUIRE_FALSE(tiles.empty());
  for (const std::uint32_t tile : tiles) {
    const RegionIndex region = job.scene().plan->region_of_tile(tile);
    CHECK(kCube.owner_of(region.column, region.row) == *owner);
  }
}

TEST_CASE("no copy is made beyond a node's room for slices") {
  const std::size_t small = kSmallSlices / 2, large = 4 * kSmallSlices;
  SECTION("small ones always fit") {
    RenderJob job = job_with_slices({small, small, small, small});
    empty(job, Rank{0});
    CHECK(job.next_copy(Rank{0}));
  }
  SECTION("equal ones fit twice") {
    RenderJob job = job_with_slices({large, large, large, large});
    empty(job, Rank{0});
    const auto owner = job.next_copy(Rank{0});
    REQUIRE(owner);
    job.set_copied(Rank{0}, *owner);
    empty(job, Rank{0});
    empty(job, *owner);
    CHECK_FALSE(job.next_copy(Rank{0}));
  }
  SECTION("a node that holds more than its share gets none") {
    RenderJob job = job_with_slices({3 * large, large, large, large});
    empty(job, Rank{0});
    CHECK_FALSE(job.next_copy(Rank{0}));
  }
}

TEST_CASE("copies are made only where boundaries are left open and rays are forwarded on credit") {
  const auto copies = [](const control::JobOptions& options, std::uint32_t nodes = 4) {
    return prepared(corner_scene(), options, nodes).makes_copies;
  };
  CHECK(copies({}));
  CHECK(copies({.shadows = ShadowMode::kForward}));
  CHECK_FALSE(copies({}, 1));
  CHECK_FALSE(copies({.partition = PartitionMode::kRegular}));
  CHECK_FALSE(copies({.partition = PartitionMode::kBalanced}));
  CHECK_FALSE(copies({.shadows = ShadowMode::kLocal}));
  CHECK_FALSE(copies({.flow = FlowMode::kBlocking}));
}
