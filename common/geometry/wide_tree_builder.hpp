// Builds hierarchies of WideNodes from the top, by the surface-area heuristic. `Parts` passes in
// what differs between hierarchies: their boxes, how a group is split and what becomes an item.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "geometry/float_box.hpp"
#include "geometry/wide_node.hpp"
#include "stop_point.hpp"

namespace graycube {

/// A slice of a group: the bounds of the things whose centres are in it, and their number.
template <typename Box>
struct Bin {
  Box box = Box::nothing();
  std::size_t count = 0;

  void add(const Box& other, std::size_t others) {
    box = union_of(box, other);
    count += others;
  }
};

/// The best place to cut a row of bins in two, and its cost: the sum of both parts' half areas,
/// each times the number of things in the part.
template <typename Box>
struct Cut {
  using Cost = decltype(Box::nothing().half_area());
  Cost cost = std::numeric_limits<Cost>::infinity();
  /// The last bin of the first part; meaningless where the cost is infinite.
  std::size_t bin = 0;
};

inline constexpr std::size_t kMaxBins = 16;

/// The cheapest cut of up to kMaxBins bins, the first of equal ones; both parts have something in
/// them. `all` is the number of things in all bins.
template <typename Box>
Cut<Box> cheapest_cut(std::span<const Bin<Box>> bins, std::size_t all) {
  using Cost = typename Cut<Box>::Cost;
  std::array<Cost, kMaxBins> above_cost{};
  Bin<Box> above;
  for (std::size_t b = bins.size() - 1; b > 0; --b) {
    above.add(bins[b].box, bins[b].count);
    above_cost[b] = above.count == 0 ? 0 : above.box.half_area() * static_cast<Cost>(above.count);
  }
  Bin<Box> below;
  Cut<Box> best;
  for (std::size_t b = 0; b + 1 < bins.size(); ++b) {
    below.add(bins[b].box, bins[b].count);
    if (below.count == 0 || below.count == all) continue;
    const Cost cost = below.box.half_area() * static_cast<Cost>(below.count) + above_cost[b + 1];
    if (cost < best.cost) best = {cost, b};
  }
  return best;
}

/// `Parts` says what the hierarchy is made of, by numbers of 32 bits:
///   Box               the type of its boxes, FloatBox or Aabb
///   box(number)       the box of one
///   kMostTogether     groups of up to so many become an item
///   split(numbers)    sorts a larger group into two; the size of the first, between both ends
///   add_item(numbers) the number of a new item that a group becomes
template <typename Parts>
class WideTreeBuilder {
 public:
  using Run = std::span<std::uint32_t>;
  /// From this depth on groups are simply halved, so that no set of boxes, however skewed, makes
  /// the hierarchy much deeper. Each further level at least halves the largest group.
  static constexpr std::size_t kMaxChosenDepth = 40;

  WideTreeBuilder(Parts& parts, std::vector<WideNode>& nodes) : parts_(parts), nodes_(nodes) {}

  /// Appends the hierarchy to the nodes, its root first; reorders the numbers.
  void run(Run all) {
    nodes_.emplace_back();
    build_node(nodes_.size() - 1, all, 0);
  }

 private:
  using Box = typename Parts::Box;
  struct Group {
    Run run;
    Box box;

    bool is_item() const { return run.size() <= Parts::kMostTogether; }
  };

  Group group_of(Run run) const {
    Group g{run, Box::nothing()};
    for (const std::uint32_t i : run) g.box = union_of(g.box, parts_.box(i));
    return g;
  }

  /// The groups that become a node's children: the one with the largest surface is opened next.
  std::vector<Group> children_of(Run run, std::size_t depth) {
    std::vector<Group> groups{group_of(run)};
    while (groups.size() < WideNode::kWidth) {
      stop_if_asked();
      std::size_t widest = groups.size();
      for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups[g].is_item()) continue;
        if (widest == groups.size() || groups[g].box.half_area() > groups[widest].box.half_area())
          widest = g;
      }
      if (widest == groups.size()) break;
      const Run all = groups[widest].run;
      const std::size_t middle = depth < kMaxChosenDepth ? parts_.split(all) : all.size() / 2;
      groups[widest] = group_of(all.first(middle));
      groups.push_back(group_of(all.subspan(middle)));
    }
    return groups;
  }

  void build_node(std::size_t index, Run run, std::size_t depth) {
    const std::vector<Group> groups = children_of(run, depth);
    WideNode node;
    for (std::size_t g = 0; g < WideNode::kWidth; ++g) {
      if (g >= groups.size()) {
        node.set_box(g, FloatBox::nothing());
        continue;
      }
      node.set_box(g, float_box_around(groups[g].box));
      if (groups[g].is_item()) {
        node.child[g] = WideNode::kItemFlag | parts_.add_item(groups[g].run);
      } else {
        node.child[g] = static_cast<std::uint32_t>(nodes_.size());
        nodes_.emplace_back();
      }
    }
    nodes_[index] = node;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (!groups[g].is_item()) build_node(node.child[g], groups[g].run, depth + 1);
    }
  }

  Parts& parts_;
  std::vector<WideNode>& nodes_;
};

}  // namespace graycube
