#include "topology/spanning_tree.hpp"

#include <algorithm>
#include <bit>

#include "topology/gray.hpp"

namespace graycube {

std::optional<Rank> SpanningTree::parent(Rank rank) const {
  if (shape_ == Shape::kBinomial) return cube_.tree_parent(rank);
  if (depth(rank) == 0) return std::nullopt;
  return cube_.ring_previous(rank);
}

std::vector<Rank> SpanningTree::children(Rank rank) const {
  if (shape_ == Shape::kBinomial) return cube_.tree_children(rank);
  if (depth(rank) + 1 == cube_.nodes()) return {};
  return {cube_.ring_next(rank)};
}

std::optional<Rank> SpanningTree::child_towards(Rank from, Rank to) const {
  if (shape_ == Shape::kChain) {
    if (depth(to) <= depth(from)) return std::nullopt;
    return cube_.ring_next(from);
  }
  Rank child = to;
  for (auto above = parent(to); above; above = parent(child)) {
    if (*above == from) return child;
    child = *above;
  }
  return std::nullopt;
}

std::vector<Rank> SpanningTree::farthest_first() const {
  std::vector<Rank> ranks;
  for (std::uint32_t r = 1; r < cube_.nodes(); ++r) ranks.push_back({r});
  std::stable_sort(ranks.begin(), ranks.end(),
                   [this](Rank a, Rank b) { return depth(a) > depth(b); });
  return ranks;
}

std::uint32_t SpanningTree::depth(Rank rank) const {
  const std::uint32_t label = cube_.label_of(rank).value;
  return shape_ == Shape::kBinomial ? static_cast<std::uint32_t>(std::popcount(label))
                                    : gray_rank(label);
}

}  // namespace graycube
