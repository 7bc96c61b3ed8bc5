// Which nodes get copies of their neighbours' slices, and when.
#include <catch2/catch.hpp>
#include <numeric>

#include "frontal/prepared.hpp"
#include "frontal/rendering/render_job.hpp"
#include "frontal/preparation/slices.hpp"
#include "trace/corner_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

const Hypercube kCube = *Hypercube::of_size(4);

/// A job whose slices are that long; only their sizes matter here.
RenderJob job_with_slices(const std::vector<std::size_t>& bytes) {
  PreparedScene cut = prepared(corner_scene(), {});
  for (std::size_t i = 0; i < bytes.size(); ++i) cut.slices[i] = Bytes(bytes[i]);
  cut.copy_room =
      copy_room(std::accumulate(bytes.begin(), bytes.end(), std::size_t{0}), kCube.nodes());
  return RenderJob(1, std::move(cut), kCube, 1);
}

constexpr Rank kOwner{0};

}  // namespace

TEST_CASE("a neighbour gets a copy of a slice once, another node never") {
  RenderJob job = job_with_slices({1000, 2000, 3000, 4000});
  for (std::uint32_t rank = 0; rank < 4; ++rank) {
    const Rank helper{rank};
    INFO("rank " << rank);
    const SharedBytes* slice = job.slice_to_copy(kOwner, helper);
    REQUIRE((slice != nullptr) == kCube.link_between(kOwner, helper).has_value());
    if (slice != nullptr) CHECK(slice->size() == 1000);
    CHECK(job.slice_to_copy(kOwner, helper) == nullptr);
  }
}

TEST_CASE("a slice is there to be copied when its node has got it") {
  RenderJob job = job_with_slices({1000, 2000, 3000, 4000});
  const std::size_t sent = job.take_slice(kOwner).size();
  const SharedBytes* slice = job.slice_to_copy(kOwner, kCube.neighbour(kOwner, 0));
  REQUIRE(slice != nullptr);
  CHECK(slice->size() == sent);
}

TEST_CASE("no copy is made beyond a node's room for slices") {
  const std::size_t small = kSmallCopies / 3, large = 4 * kSmallCopies;
  const Rank helper = kCube.neighbour(kOwner, 0), third = kCube.neighbour(helper, 1);
  SECTION("small ones fit, however many") {
    RenderJob job = job_with_slices({small, small, small, small});
    CHECK(job.slice_to_copy(kOwner, helper) != nullptr);
    CHECK(job.slice_to_copy(third, helper) != nullptr);
  }
  SECTION("of large ones, one beside the node's own") {
    RenderJob job = job_with_slices({large, large, large, large});
    CHECK(job.slice_to_copy(kOwner, helper) != nullptr);
    CHECK(job.slice_to_copy(third, helper) == nullptr);
    CHECK(job.slice_to_copy(third, kCube.neighbour(third, 0)) != nullptr);
  }
  SECTION("a node that holds more than its share gets none") {
    std::vector<std::size_t> bytes(4, large);
    bytes[helper.value] = 2 * large;
    RenderJob job = job_with_slices(bytes);
    CHECK(job.slice_to_copy(kOwner, helper) == nullptr);
    CHECK(job.slice_to_copy(helper, kOwner) == nullptr);
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
