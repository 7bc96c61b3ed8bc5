#include "geometry/wide_tree_builder.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include "catch.hpp"

using namespace graycube;

namespace {

/// Boxes under a hierarchy whose items are groups of up to three, split by halves.
struct Halves {
  using Box = Aabb;
  static constexpr std::size_t kMostTogether = 3;

  const Aabb& box(std::uint32_t i) const { return boxes[i]; }
  std::size_t split(std::span<std::uint32_t> run) { return run.size() / 2; }
  std::uint32_t add_item(std::span<std::uint32_t> run) {
    items.emplace_back(run.begin(), run.end());
    return static_cast<std::uint32_t>(items.size() - 1);
  }

  std::vector<Aabb> boxes;
  std::vector<std::vector<std::uint32_t>> items;
};

Halves random_boxes(std::size_t count) {
  std::mt19937 random(static_cast<unsigned>(count));
  std::uniform_real_distribution<double> place(-10, 10), size(0, 1);
  Halves parts;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 lo{place(random), place(random), place(random)};
    parts.boxes.push_back({lo, lo + Vec3{size(random), size(random), size(random)}});
  }
  return parts;
}

std::vector<WideNode> built(Halves& parts) {
  std::vector<std::uint32_t> all(parts.boxes.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<WideNode> nodes;
  WideTreeBuilder<Halves>(parts, nodes).run(all);
  return nodes;
}

bool holds(const FloatBox& box, const Aabb& inner) {
  bool all = true;
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    all = all && double{box.lo[a]} <= inner.lo[axis] && double{box.hi[a]} >= inner.hi[axis];
  }
  return all;
}

/// Checks that all items below a place of a node lie in its box; marks the items that are there.
void check_below(const std::vector<WideNode>& nodes, const WideNode& node, std::size_t place,
                 const Halves& parts, const FloatBox& box, std::vector<int>& found) {
  if (node.is_item(place)) {
    for (const std::uint32_t i : parts.items[node.item(place)]) {
      CHECK(holds(box, parts.boxes[i]));
      ++found[i];
    }
    return;
  }
  const WideNode& child = nodes[node.child[place]];
  for (std::size_t i = 0; i < WideNode::kWidth; ++i) {
    if (child.is_used(i)) check_below(nodes, child, i, parts, box, found);
  }
}

}  // namespace

TEST_CASE("a hierarchy of boxes has each in one item, within all boxes above it") {
  for (const std::size_t count : {1u, 3u, 4u, 9u, 100u, 700u}) {
    INFO(count << " boxes");
    Halves parts = random_boxes(count);
    const std::vector<WideNode> nodes = built(parts);
    for (const WideNode& node : nodes) {
      for (std::size_t i = 0; i < WideNode::kWidth; ++i) {
        std::vector<int> below(count);
        if (node.is_used(i)) check_below(nodes, node, i, parts, node.box(i), below);
      }
    }
    std::vector<int> found(count);
    for (std::size_t i = 0; i < WideNode::kWidth; ++i) {
      if (nodes.front().is_used(i))
        check_below(nodes, nodes.front(), i, parts, nodes.front().box(i), found);
    }
    CHECK(std::all_of(found.begin(), found.end(), [](int times) { return times == 1; }));
    for (const auto& item : parts.items) CHECK(item.size() <= Halves::kMostTogether);
  }
}

TEST_CASE("bins are cut where both parts cost least, and nowhere when all are in one") {
  const auto bin = [](double lo, double hi, std::size_t count) {
    return Bin<Aabb>{{{lo, 0, 0}, {hi, 1, 1}}, count};
  };
  const std::vector<Bin<Aabb>> bins{bin(0, 1, 3), bin(1, 2, 1), {}, bin(9, 10, 4)};
  const auto cut = cheapest_cut<Aabb>(bins, 8);
  CHECK(cut.bin == 1);
  // The half areas are those of 2 × 1 × 1 and of 1 × 1 × 1.
  CHECK(cut.cost == 5 * 4 + 3 * 4);
  CHECK(cheapest_cut<Aabb>(std::vector<Bin<Aabb>>{{}, bin(0, 1, 8), {}}, 8).cost == kInf);
}
