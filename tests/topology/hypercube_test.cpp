#include "topology/hypercube.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <set>

#include "catch.hpp"
#include "topology/gray.hpp"

namespace graycube {
namespace {

template <class Check>
void for_each_cube(Check&& check) {
  for (std::uint32_t nodes = 1; nodes <= kMaxNodes; nodes *= 2) {
    const auto cube = Hypercube::of_size(nodes);
    REQUIRE(cube);
    CAPTURE(nodes);
    check(*cube);
  }
}

bool linked(const Hypercube& cube, Rank a, Rank b) {
  return std::popcount(cube.label_of(a).value ^ cube.label_of(b).value) == 1;
}

TEST_CASE("consecutive Gray codes differ in one bit and have an inverse") {
  STATIC_REQUIRE(gray_code(0) == 0);
  STATIC_REQUIRE(gray_code(2) == 3);
  for (std::uint32_t i = 0; i < 5000; ++i) {
    CHECK(gray_rank(gray_code(i)) == i);
    CHECK(std::popcount(gray_code(i) ^ gray_code(i + 1)) == 1);
  }
  CHECK(gray_rank(gray_code(0xffffffffu)) == 0xffffffffu);
}

TEST_CASE("a hypercube has a power of two of nodes, at most 1024") {
  const std::uint64_t wrong[] = {0, 3, 6, 1000, 2048, (1ull << 32) + 1, 1ull << 40};
  for (const std::uint64_t nodes : wrong) {
    CHECK_FALSE(Hypercube::of_size(nodes));
  }
  for_each_cube([](const Hypercube& cube) {
    CHECK(cube.nodes() == 1u << cube.dimension());
    CHECK(cube.columns() * cube.rows() == cube.nodes());
    CHECK((cube.columns() == cube.rows() || cube.columns() == 2 * cube.rows()));
  });
}

TEST_CASE("eight nodes are a grid of four columns and two rows") {
  const auto cube = Hypercube::of_size(8);
  REQUIRE(cube);
  CHECK(cube->dimension() == 3);
  CHECK(cube->columns() == 4);
  CHECK(cube->rows() == 2);
  CHECK(cube->rank_at(2, 1) == Rank{5});
  CHECK(cube->label_of(Rank{5}) == GrayLabel{0b111});  // gray(1) = 1 above gray(2) = 11
}

TEST_CASE("consecutive ranks are linked, as neighbours in the grid") {
  for_each_cube([](const Hypercube& cube) {
    for (Rank rank; cube.has({rank.value + 1}); ++rank.value) {
      const Rank next{rank.value + 1};
      REQUIRE(cube.link_between(rank, next));
      const auto apart = [](std::uint32_t a, std::uint32_t b) { return a < b ? b - a : a - b; };
      REQUIRE(apart(cube.column_of(rank), cube.column_of(next)) +
                  apart(cube.row_of(rank), cube.row_of(next)) ==
              1);
    }
  });
}

TEST_CASE(
    "every aligned block of ranks is a subcube, and a block of the grid about as high as wide") {
  for_each_cube([](const Hypercube& cube) {
    for (std::uint32_t size = 1; size <= cube.nodes(); size *= 2) {
      for (std::uint32_t first = 0; first < cube.nodes(); first += size) {
        std::uint32_t bits = 0, left = cube.columns(), right = 0, top = cube.rows(), bottom = 0;
        for (Rank rank{first}; rank.value < first + size; ++rank.value) {
          bits |= cube.label_of(rank).value ^ cube.label_of(Rank{first}).value;
          left = std::min(left, cube.column_of(rank));
          right = std::max(right, cube.column_of(rank));
          top = std::min(top, cube.row_of(rank));
          bottom = std::max(bottom, cube.row_of(rank));
        }
        const std::uint32_t width = right - left + 1, height = bottom - top + 1;
        REQUIRE(1u << std::popcount(bits) == size);
        REQUIRE(width * height == size);
        REQUIRE((width <= 2 * height && height <= 2 * width));
      }
    }
  });
}

TEST_CASE("rank, label and place in the grid name the same node") {
  for_each_cube([](const Hypercube& cube) {
    std::set<GrayLabel> labels;
    for (Rank rank; cube.has(rank); ++rank.value) {
      CHECK(cube.rank_at(cube.column_of(rank), cube.row_of(rank)) == rank);
      CHECK(cube.rank_of(cube.label_of(rank)) == rank);
      CHECK(cube.label_of(rank).value < cube.nodes());
      labels.insert(cube.label_of(rank));
    }
    CHECK(labels.size() == cube.nodes());
    CHECK(cube.label_of(Rank{0}) == GrayLabel{0});
  });
}

TEST_CASE("links join nodes both ways, one for each bit") {
  for_each_cube([](const Hypercube& cube) {
    for (Rank rank; cube.has(rank); ++rank.value) {
      CHECK_FALSE(cube.link_between(rank, rank));
      for (std::uint32_t bit = 0; bit < cube.dimension(); ++bit) {
        const Rank other = cube.neighbour(rank, bit);
        CHECK(cube.neighbour(other, bit) == rank);
        CHECK(cube.link_between(rank, other) == bit);
      }
    }
  });
  const auto cube = Hypercube::of_size(4);
  REQUIRE(cube);
  CHECK_FALSE(cube->link_between(Rank{0}, Rank{2}));
}

TEST_CASE(
    "the first bit on the way leads nearer, and past a node that is to be left out unless it is "
    "the goal") {
  for_each_cube([](const Hypercube& cube) {
    if (cube.nodes() > 64) return;
    for (Rank from; cube.has(from); ++from.value) {
      for (Rank to; cube.has(to); ++to.value) {
        if (from == to) continue;
        const auto distance = [&](Rank a) {
          return std::popcount(cube.label_of(a).value ^ cube.label_of(to).value);
        };
        const std::uint32_t bit = cube.first_bit(from, to);
        CHECK(distance(cube.neighbour(from, bit)) == distance(from) - 1);
        const std::uint32_t other = cube.first_bit(from, to, bit);
        CHECK(distance(cube.neighbour(from, other)) == distance(from) - 1);
        CHECK((other != bit) == (distance(from) > 1));
      }
    }
  });
}

TEST_CASE("the ring visits every node once, over links only, and comes back to rank 0") {
  for_each_cube([](const Hypercube& cube) {
    std::set<Rank> visited;
    Rank rank{0};
    do {
      CHECK(visited.insert(rank).second);
      const Rank next = cube.ring_next(rank);
      CHECK(cube.ring_previous(next) == rank);
      CHECK((linked(cube, rank, next) || cube.nodes() == 1));
      rank = next;
    } while (rank != Rank{0} && visited.size() <= cube.nodes());
    CHECK(visited.size() == cube.nodes());
  });
}

TEST_CASE("the tree reaches every node from rank 0 over links") {
  for_each_cube([](const Hypercube& cube) {
    CHECK_FALSE(cube.tree_parent(Rank{0}));
    std::uint32_t children = 0;
    for (Rank rank; cube.has(rank); ++rank.value) {
      std::uint32_t steps = 0;
      for (auto up = cube.tree_parent(rank); up; up = cube.tree_parent(*up)) {
        REQUIRE(++steps <= cube.dimension());
      }
      for (const Rank child : cube.tree_children(rank)) {
        ++children;
        CHECK(cube.tree_parent(child) == rank);
        CHECK(linked(cube, rank, child));
      }
    }
    CHECK(children == cube.nodes() - 1);
  });
}

}  // namespace
}  // namespace graycube
