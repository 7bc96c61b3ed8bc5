// Which hosts nodes lie on.
#include "topology/host_placement.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <random>
#include <vector>

#include "catch.hpp"

using namespace graycube;

namespace {

std::vector<std::uint32_t> nodes_on(const HostPlacement& placement) {
  std::vector<std::uint32_t> count(placement.hosts(), 0);
  for (std::uint32_t r = 0; r < placement.nodes(); ++r) ++count[placement.host_of(Rank{r})];
  return count;
}

/// Pairs of grid neighbours, without those round the ends, that lie on different hosts.
std::uint32_t split_pairs(const Hypercube& cube, const HostPlacement& placement) {
  std::uint32_t split = 0;
  const auto add = [&](Rank a, Rank b) {
    split += placement.host_of(a) != placement.host_of(b) ? 1 : 0;
  };
  for (std::uint32_t row = 0; row < cube.rows(); ++row) {
    for (std::uint32_t column = 0; column < cube.columns(); ++column) {
      const Rank here = cube.rank_at(column, row);
      if (column + 1 < cube.columns()) add(here, cube.rank_at(column + 1, row));
      if (row + 1 < cube.rows()) add(here, cube.rank_at(column, row + 1));
    }
  }
  return split;
}

HostPlacement dealt_at_random(std::uint32_t nodes, std::uint32_t hosts, unsigned seed) {
  std::vector<std::uint32_t> host_by_rank(nodes);
  for (std::uint32_t r = 0; r < nodes; ++r) host_by_rank[r] = r % hosts;
  std::ranges::shuffle(host_by_rank, std::mt19937(seed));
  return {hosts, host_by_rank};
}

}  // namespace

TEST_CASE("each host has consecutive ranks, and as many as its slots allow") {
  for (unsigned seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    const std::uint32_t nodes = 1u << random() % 8;
    std::vector<std::uint32_t> slots(1 + random() % 12);
    for (std::uint32_t& s : slots) s = static_cast<std::uint32_t>(random() % 40);
    const auto placement = HostPlacement::of(nodes, slots);
    const bool fits = std::accumulate(slots.begin(), slots.end(), 0u) >= nodes;
    REQUIRE(placement.has_value() == fits);
    if (!fits) continue;
    CHECK(placement->nodes() == nodes);
    const std::vector<std::uint32_t> count = nodes_on(*placement);
    for (std::size_t h = 0; h < slots.size(); ++h) CHECK(count[h] <= slots[h]);
    std::uint32_t changes = 0;
    for (std::uint32_t r = 1; r < nodes; ++r)
      changes += placement->host_of(Rank{r}) != placement->host_of(Rank{r - 1}) ? 1 : 0;
    CHECK(changes + 1 == slots.size() - static_cast<std::size_t>(std::ranges::count(count, 0u)));
  }
}

TEST_CASE("no slot has more to do than it must") {
  // Another node on any other host would bring it at least to the busiest one's load.
  for (unsigned seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::vector<std::uint32_t> slots(1 + random() % 8);
    for (std::uint32_t& s : slots) s = static_cast<std::uint32_t>(1 + random() % 40);
    const std::uint32_t nodes = most_nodes(slots);
    const auto placement = HostPlacement::of(nodes, slots);
    REQUIRE(placement);
    const std::vector<std::uint32_t> count = nodes_on(*placement);
    for (std::size_t busy = 0; busy < slots.size(); ++busy) {
      for (std::size_t h = 0; h < slots.size(); ++h) {
        if (count[h] < slots[h]) CHECK((count[h] + 1) * slots[busy] >= count[busy] * slots[h]);
      }
    }
  }
}

TEST_CASE("hosts of powers of two of nodes are subcubes and compact, wherever they are named") {
  const std::vector<std::uint32_t> slots{8, 16, 8, 32};
  const auto placement = HostPlacement::of(64, slots);
  REQUIRE(placement);
  CHECK(nodes_on(*placement) == slots);
  CHECK(placement->host_of(Rank{0}) == 3);
  CHECK(placement->host_of(Rank{32}) == 1);
  CHECK(placement->host_of(Rank{48}) == 0);
  CHECK(placement->host_of(Rank{63}) == 2);
}

TEST_CASE("a farm has the largest power of two of nodes for which there are slots") {
  CHECK(most_nodes({}) == 0);
  CHECK(most_nodes(std::vector<std::uint32_t>{0}) == 0);
  CHECK(most_nodes(std::vector<std::uint32_t>{3, 4, 5}) == 8);
  CHECK(most_nodes(std::vector<std::uint32_t>{8, 8}) == 16);
  CHECK(most_nodes(std::vector<std::uint32_t>(1024, 0xFFFFFFFF)) == kMaxNodes);
}

TEST_CASE("hosts hold at least twice as many pairs of grid neighbours as when dealt at random") {
  for (const std::uint32_t nodes : {16u, 32u, 64u, 128u, 256u, 512u, 1024u}) {
    const Hypercube cube = *Hypercube::of_size(nodes);
    for (std::uint32_t hosts = 2; hosts * 4 <= nodes; ++hosts) {
      INFO(nodes << " nodes on " << hosts << " hosts");
      const std::uint32_t split = split_pairs(cube, HostPlacement::even(nodes, hosts));
      std::uint32_t least = ~0u;
      for (unsigned seed = 0; seed < 5; ++seed)
        least = std::min(least, split_pairs(cube, dealt_at_random(nodes, hosts, seed)));
      // Four nodes a host have half of their pairs outside whatever is done.
      if (nodes / hosts >= 8) CHECK(2 * split <= least);
      CHECK(3 * split <= 2 * least);
    }
  }
}
