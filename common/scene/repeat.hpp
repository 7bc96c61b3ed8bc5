// The copies of a repeat: its child under products of its maps.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "saturating.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// Saturating counts (saturating.hpp).
struct RepeatCounts {
  /// Products under which the child is placed.
  std::uint64_t copies = 0;
  /// Products of any number of maps up to the depth, the empty one included: those that are
  /// computed on the way to the copies.
  std::uint64_t products = 0;
};

constexpr RepeatCounts counts_of_repeat(std::uint64_t maps, std::uint32_t depth, KeptCopies kept) {
  std::uint64_t deepest = 1, products = 1;
  for (std::uint32_t level = 0; level < depth; ++level) {
    deepest = saturating_product(deepest, maps);
    products = saturating_sum(products, deepest);
  }
  return {kept == KeptCopies::kAll ? products : deepest, products};
}
inline RepeatCounts counts_of(const RepeatNode& node) {
  return counts_of_repeat(node.maps.size(), node.depth, node.kept);
}

/// Calls visit(map, level) for each copy, `level` being how many of the repeat's maps are in the
/// product, which begins with `start`. A copy comes before those under further maps, and these come
/// in the order of the maps, as in refs to shapes that are the union of the child and of refs to
/// the shape one level lower, one under each map. `Map` is Affine or MeasuredMap; both have
/// compose(then, first).
template <typename Map, typename Visit>
void for_each_copy(const RepeatNode& node, const Map& start, const Visit& visit) {
  struct Step {
    Map map;
    std::size_t next = 0;
  };
  std::vector<Step> path;
  const auto reach = [&](const Map& map) {
    const std::size_t level = path.size();
    if (node.kept == KeptCopies::kAll || level == node.depth) visit(map, level);
    if (level < node.depth) path.push_back({map});
  };
  reach(start);
  while (!path.empty()) {
    Step& step = path.back();
    if (step.next == node.maps.size()) {
      path.pop_back();
    } else {
      // The step moves when the path grows, but the product is a value of its own.
      reach(compose(step.map, node.maps[step.next++]));
    }
  }
}

}  // namespace graycube
