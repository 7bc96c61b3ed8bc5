// Programs as operations on bits, compared with the trees that they come from.
#include "crossings/masked_program.hpp"

#include <span>
#include <vector>

#include "catch.hpp"
#include "crossings/crossings.hpp"
#include "csg/dice.hpp"

using namespace graycube;
using namespace graycube::crossings;
using graycube::testing::Dice;

namespace {

/// A random tree whose leaf number i is primitive i.
void add_tree(Dice& dice, int depth, std::uint32_t& leaves, std::vector<TreeNode>& tree) {
  using Kind = TreeNode::Kind;
  if (depth == 0 || dice.one_in(4)) {
    tree.push_back({dice.one_in(3) ? Kind::kInvertedLeaf : Kind::kLeaf, leaves++, 1});
    return;
  }
  const std::size_t root = tree.size();
  tree.push_back({dice.one_in(2) ? Kind::kAnd : Kind::kOr, 0, 1});
  const std::uint64_t children = 2 + dice.below(3);
  for (std::uint64_t i = 0; i < children; ++i) add_tree(dice, depth - 1, leaves, tree);
  tree[root].size = static_cast<std::uint32_t>(tree.size() - root);
}

std::uint64_t inverted_leaves(std::span<const TreeNode> tree) {
  std::uint64_t inverted = 0;
  for (const TreeNode& n : tree) {
    if (n.kind == TreeNode::Kind::kInvertedLeaf) inverted |= std::uint64_t{1} << n.primitive;
  }
  return inverted;
}

bool tree_member(std::span<const TreeNode> tree, std::uint64_t flags) {
  std::uint32_t literal = 0;
  return member(tree, std::span(&flags, 1), literal);
}

}  // namespace

TEST_CASE(
    "a masked program has the members of its tree, and the same literal shows where they change") {
  std::size_t changes = 0, too_large = 0;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    std::vector<TreeNode> tree;
    std::uint32_t leaves = 0;
    add_tree(dice, 1 + static_cast<int>(dice.below(3)), leaves, tree);
    if (tree.size() == 1) continue;
    // The program stands behind operations of others, as in a surface tree.
    std::vector<MaskOperation> operations(dice.below(3));
    const std::size_t first = operations.size();
    if (!MaskedProgram::append(tree, operations)) {
      ++too_large;
      REQUIRE((leaves > kMaxFlatLiterals || tree.size() > MaskedProgram::kMaxNodes));
      REQUIRE(operations.size() == first);
      continue;
    }
    const std::span<const MaskOperation> own =
        std::span<const MaskOperation>{operations}.subspan(first);
    const MaskedProgram program{own, inverted_leaves(tree), leaves};
    const std::uint64_t all = (std::uint64_t{1} << leaves) - 1;
    for (int i = 0; i < 50; ++i) {
      const std::uint64_t before = dice.below(all + 1),
                          after = before ^ (dice.below(all + 1) & dice.below(all + 1));
      REQUIRE(program.is_member(before) == tree_member(tree, before));
      REQUIRE(program.is_member(after) == tree_member(tree, after));
      if (program.is_member(before) == program.is_member(after)) continue;
      ++changes;
      REQUIRE(program.changed_literal(before, after) ==
              changed_primitive(tree, std::span(&before, 1), std::span(&after, 1), 0));
    }
  }
  CHECK(changes > 10000);
  CHECK(too_large > 10);
}

TEST_CASE("few events change membership where groups of equal t do, from t0 on and before t1") {
  FewEvents events(1, 10);
  events.add(0, -3, 2);  // inside at t0
  events.add(1, 2, 5);   // takes over at 2, together
  events.add(2, 5, 5);   // nothing
  events.add(3, 7, 12);  // reaches beyond t1
  events.add(4, 0, 1);   // ends at t0, which counts
  std::vector<double> at;
  events.visit_changes([](std::uint64_t flags) { return (flags & 0b01111) != 0; },
                       [&](double t, bool entering, std::uint64_t, std::uint64_t) {
                         at.push_back(entering ? t : -t);
                         return true;
                       });
  CHECK(at == std::vector<double>{-5, 7});
  at.clear();
  events.visit_changes([](std::uint64_t flags) { return (flags & 0b10000) != 0; },
                       [&](double t, bool, std::uint64_t before, std::uint64_t after) {
                         at.push_back(t);
                         CHECK(before == 0b10001);
                         CHECK(after == 0b00001);
                         return false;
                       });
  CHECK(at == std::vector<double>{1});
  CHECK(FewEvents(1, 10).is_empty());
}
