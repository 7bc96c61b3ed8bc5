// Which nodes get copies of their neighbours' slices, and when.
#include <numeric>

#include "catch.hpp"
#include "frontal/preparation/slices.hpp"
#include "frontal/prepared.hpp"
#include "frontal/rendering/slice_stock.hpp"
#include "trace/corner_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

const Hypercube kCube = *Hypercube::of_size(4);

/// Slices of these lengths, of which neighbours may get copies; only the lengths matter here.
SliceStock stock_of(const std::vector<std::size_t>& bytes) {
  std::vector<SharedBytes> slices;
  for (const std::size_t size : bytes) slices.emplace_back(Bytes(size));
  const std::size_t all = std::accumulate(bytes.begin(), bytes.end(), std::size_t{0});
  return {kCube, std::move(slices), {.are_copied = true, .room = copy_room(all, kCube.nodes())}};
}

constexpr Rank kOwner{0};

}  // namespace

TEST_CASE("a neighbour gets a copy of a slice once, another node never") {
  SliceStock stock = stock_of({1000, 2000, 3000, 4000});
  for (std::uint32_t rank = 0; rank < 4; ++rank) {
    const Rank helper{rank};
    INFO("rank " << rank);
    const SharedBytes* slice = stock.to_copy(kOwner, helper);
    REQUIRE((slice != nullptr) == kCube.link_between(kOwner, helper).has_value());
    if (slice != nullptr) CHECK(slice->size() == 1000);
    CHECK(stock.to_copy(kOwner, helper) == nullptr);
  }
}

TEST_CASE("a slice is there to be copied when its node has got it") {
  SliceStock stock = stock_of({1000, 2000, 3000, 4000});
  const std::size_t sent = stock.of(kOwner).size();
  const SharedBytes* slice = stock.to_copy(kOwner, kCube.neighbour(kOwner, 0));
  REQUIRE(slice != nullptr);
  CHECK(slice->size() == sent);
}

TEST_CASE("no copy is made beyond a node's room for slices") {
  const std::size_t small = kSmallCopies / 3, large = 4 * kSmallCopies;
  const Rank helper = kCube.neighbour(kOwner, 0), third = kCube.neighbour(helper, 1);
  SECTION("small ones fit, however many") {
    SliceStock stock = stock_of({small, small, small, small});
    CHECK(stock.to_copy(kOwner, helper) != nullptr);
    CHECK(stock.to_copy(third, helper) != nullptr);
  }
  SECTION("of large ones, one beside the node's own") {
    SliceStock stock = stock_of({large, large, large, large});
    CHECK(stock.to_copy(kOwner, helper) != nullptr);
    CHECK(stock.to_copy(third, helper) == nullptr);
    CHECK(stock.to_copy(third, kCube.neighbour(third, 0)) != nullptr);
  }
  SECTION("a node that holds more than its share gets none") {
    std::vector<std::size_t> bytes(4, large);
    bytes[helper.value] = 2 * large;
    SliceStock stock = stock_of(bytes);
    CHECK(stock.to_copy(kOwner, helper) == nullptr);
    CHECK(stock.to_copy(helper, kOwner) == nullptr);
  }
}

TEST_CASE("a slice is lent to any node where slices are, and else to none") {
  const auto slices = [] { return std::vector<SharedBytes>(4, Bytes(10)); };
  SliceStock lent(kCube, slices(), {.are_lent = true});
  REQUIRE(lent.to_lend(3) != nullptr);
  CHECK(lent.to_lend(4) == nullptr);
  CHECK(lent.to_lend(3)->size() == 10);
  SliceStock kept(kCube, slices(), {});
  CHECK(kept.to_lend(3) == nullptr);
}

TEST_CASE("a slice is there for as many processes of a rank as there are; one for all, too") {
  SliceStock own(kCube, std::vector<SharedBytes>(4, Bytes(10)), {});
  for (int process = 0; process < 3; ++process) CHECK(own.of(Rank{1}).size() == 10);
  SliceStock whole(kCube, {Bytes(10)}, {});
  for (std::uint32_t rank = 0; rank < 4; ++rank) CHECK(whole.of(Rank{rank}).size() == 10);
}

TEST_CASE("a node that is lost loses its copies, and may get them again") {
  SliceStock stock = stock_of({1000, 2000, 3000, 4000});
  const Rank helper = kCube.neighbour(kOwner, 0);
  REQUIRE(stock.to_copy(kOwner, helper) != nullptr);
  REQUIRE(stock.to_copy(kOwner, helper) == nullptr);
  stock.lose(helper);
  CHECK(stock.to_copy(kOwner, helper) != nullptr);
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
