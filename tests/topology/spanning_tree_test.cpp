#include "topology/spanning_tree.hpp"

#include <algorithm>
#include <vector>

#include "catch.hpp"

namespace graycube {
namespace {

using Shape = SpanningTree::Shape;

template <class Check>
void for_each_tree(Check&& check) {
  for (std::uint32_t nodes = 1; nodes <= 256; nodes *= 2) {
    for (const Shape shape : {Shape::kBinomial, Shape::kChain}) {
      INFO((shape == Shape::kChain ? "chain of " : "tree of ") << nodes);
      check(SpanningTree(*Hypercube::of_size(nodes), shape), shape);
    }
  }
}

/// Links from the node up to the root.
std::uint32_t climb(const SpanningTree& tree, Rank rank) {
  std::uint32_t links = 0;
  for (auto above = tree.parent(rank); above; above = tree.parent(*above)) {
    REQUIRE(++links < tree.cube().nodes());
  }
  return links;
}

TEST_CASE("parents and children are neighbours and agree, and all nodes hang from the first") {
  for_each_tree([](const SpanningTree& tree, Shape shape) {
    for (std::uint32_t r = 0; r < tree.cube().nodes(); ++r) {
      const Rank rank{r};
      REQUIRE(tree.parent(rank).has_value() == (r != 0));
      for (const Rank child : tree.children(rank)) {
        REQUIRE(tree.cube().link_between(rank, child));
        REQUIRE(tree.parent(child) == rank);
      }
      if (const auto above = tree.parent(rank)) {
        const auto siblings = tree.children(*above);
        REQUIRE(std::ranges::count(siblings, rank) == 1);
      }
      const std::uint32_t links = climb(tree, rank);
      if (shape == Shape::kBinomial) REQUIRE(links <= tree.cube().dimension());
      if (shape == Shape::kChain) REQUIRE(tree.children(rank).size() <= 1);
    }
  });
}

TEST_CASE("a step towards a node below is one towards it, and there is none to any other") {
  for_each_tree([](const SpanningTree& tree, Shape) {
    for (std::uint32_t to = 0; to < tree.cube().nodes(); ++to) {
      std::vector<bool> is_above(tree.cube().nodes());
      for (auto above = tree.parent(Rank{to}); above; above = tree.parent(*above)) {
        is_above[above->value] = true;
        const auto child = tree.child_towards(*above, Rank{to});
        REQUIRE(child);
        REQUIRE(tree.parent(*child) == *above);
        REQUIRE((child->value == to || is_above[child->value]));
      }
      for (std::uint32_t from = 0; from < tree.cube().nodes(); ++from) {
        REQUIRE(tree.child_towards(Rank{from}, Rank{to}).has_value() == is_above[from]);
      }
    }
  });
}

TEST_CASE("the farthest nodes come first, the root never") {
  for_each_tree([](const SpanningTree& tree, Shape) {
    const std::vector<Rank> ranks = tree.farthest_first();
    REQUIRE(ranks.size() + 1 == tree.cube().nodes());
    for (std::size_t i = 0; i < ranks.size(); ++i) {
      REQUIRE(ranks[i] != Rank{0});
      if (i > 0) REQUIRE(climb(tree, ranks[i - 1]) >= climb(tree, ranks[i]));
    }
  });
}

}  // namespace
}  // namespace graycube
