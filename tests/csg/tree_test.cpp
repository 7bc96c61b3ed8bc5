// Trees of the compiled model: pruning, membership, bounds, and how the scene's trees are
// compiled.
#include "csg/tree.hpp"

#include <vector>

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "csg/whole_tree.hpp"
#include "formats/pov/scene_membership.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

using Kind = TreeNode::Kind;

/// Appends a random tree. Leaves are numbered in order; nested nodes of one kind may occur.
void grow(Dice& dice, int depth, std::uint32_t& leaves, std::vector<TreeNode>& out) {
  if (depth == 0 || dice.one_in(4)) {
    out.push_back({dice.one_in(3) ? Kind::kInvertedLeaf : Kind::kLeaf, leaves++, 1});
    return;
  }
  const std::size_t start = out.size();
  out.push_back({dice.one_in(2) ? Kind::kAnd : Kind::kOr, 0, 1});
  for (std::size_t i = 2 + dice.below(3); i > 0; --i) grow(dice, depth - 1, leaves, out);
  out[start].size = static_cast<std::uint32_t>(out.size() - start);
}

bool is_leaf(const TreeNode& n) { return n.kind == Kind::kLeaf || n.kind == Kind::kInvertedLeaf; }

/// Checks sizes; true when no operation has a single child or, if `merged`, one of its own kind.
bool is_well_formed(std::span<const TreeNode> tree, bool merged) {
  const TreeNode& root = tree.front();
  if (root.size != tree.size()) return false;
  if (is_leaf(root)) return root.size == 1;
  std::size_t children = 0, at = 1;
  while (at < root.size) {
    const TreeNode& child = tree[at];
    if (child.size == 0 || at + child.size > root.size) return false;
    if (merged && child.kind == root.kind) return false;
    if (!is_well_formed(tree.subspan(at, child.size), merged)) return false;
    at += child.size;
    ++children;
  }
  return children >= 2;
}

std::vector<std::uint32_t> leaves_of(std::span<const TreeNode> tree) {
  std::vector<std::uint32_t> r;
  for (const TreeNode& n : tree) {
    if (is_leaf(n)) r.push_back(n.primitive);
  }
  return r;
}

}  // namespace

TEST_CASE("a pruned tree has the membership of the whole one") {
  std::size_t varying = 0, constants = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    std::vector<TreeNode> tree;
    std::uint32_t leaves = 0;
    grow(dice, 4, leaves, tree);
    std::vector<CellSide> sides;
    const std::size_t crossing_share = 1 + dice.below(3);
    for (std::uint32_t i = 0; i < leaves; ++i) {
      sides.push_back(dice.one_in(crossing_share) ? CellSide::kCrosses
                      : dice.one_in(2)            ? CellSide::kInside
                                                  : CellSide::kOutside);
    }
    // Nodes that stand before the tree in the output are left alone.
    const TreeNode before{Kind::kLeaf, 4711, 1};
    std::vector<TreeNode> out{before};
    const Pruned result = prune(
        std::span<const TreeNode>(tree), [&](std::uint32_t p) { return sides[p]; }, out);
    REQUIRE(out.front() == before);
    const std::span<const TreeNode> pruned = std::span<const TreeNode>(out).subspan(1);
    if (result != Pruned::kVaries) {
      REQUIRE(pruned.empty());
      ++constants;
    } else {
      ++varying;
      REQUIRE(is_well_formed(pruned, false));
      std::uint32_t last = 0;
      for (const std::uint32_t leaf : leaves_of(pruned)) {
        REQUIRE(sides[leaf] == CellSide::kCrosses);
        REQUIRE(leaf >= last);  // the order stays
        last = leaf;
      }
    }
    for (int k = 0; k < 20; ++k) {
      std::vector<bool> truth;
      for (const CellSide s : sides)
        truth.push_back(s == CellSide::kCrosses ? dice.one_in(2) : s == CellSide::kInside);
      const auto inside = [&](std::uint32_t p) -> bool { return truth[p]; };
      const bool expected = holds(solid_of(tree), inside);
      REQUIRE(evaluate(std::span<const TreeNode>(tree), inside) == expected);
      if (result == Pruned::kVaries) {
        REQUIRE(evaluate(pruned, inside) == expected);
      } else {
        REQUIRE((result == Pruned::kEverything) == expected);
      }
    }
  }
  CHECK(varying > 1000);
  CHECK(constants > 1000);
}

TEST_CASE("pruning merges nested nodes of one kind when it starts from a merged tree") {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    INFO("seed " << seed);
    const Model model = compile_scene(RandomModel(seed).scene());
    Dice dice(seed);
    for (const Object& o : model.objects) {
      const auto tree = std::span(model.nodes).subspan(o.first_node, o.node_count);
      REQUIRE(is_well_formed(tree, true));
      std::vector<TreeNode> out;
      const auto side = [&](std::uint32_t) {
        return dice.one_in(2)   ? CellSide::kCrosses
               : dice.one_in(2) ? CellSide::kInside
                                : CellSide::kOutside;
      };
      if (prune(tree, side, out) == Pruned::kVaries) REQUIRE(is_well_formed(out, true));
    }
  }
}

TEST_CASE("bounds of a tree enclose its points") {
  std::size_t inside = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    INFO("seed " << seed);
    const Model model = compile_scene(RandomModel(seed).scene());
    const WholeTrees trees(model);
    Dice dice(seed);
    for (std::size_t o = 0; o < model.objects.size(); ++o) {
      for (int i = 0; i < 60; ++i) {
        const Vec3 p =
            dice.one_in(3) ? std::pow(10, dice.between(0, 6)) * dice.unit_vector() : dice.point(3);
        if (!trees.contains_point(o, p)) continue;
        ++inside;
        REQUIRE(model.objects[o].bounds.grown(1e-10).contains(p));
      }
    }
  }
  CHECK(inside > 2000);
}

TEST_CASE("a compiled tree holds the points of the tree as written") {
  std::size_t inside = 0, compared = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Scene scene = RandomModel(seed).scene();
    const Model model = compile_scene(scene);
    const WholeTrees trees(model);
    Dice dice(seed);
    const std::vector<SceneObject> objects = scene.objects;
    for (std::size_t o = 0; o < objects.size(); ++o) {
      INFO("seed " << seed << ", object " << o);
      REQUIRE(model.objects[o].id == o);
      scene.objects = {objects[o]};
      for (int i = 0; i < 40; ++i) {
        const Vec3 p = dice.point(3);  // almost surely on no surface
        ++compared;
        inside += trees.contains_point(o, p) ? 1 : 0;
        REQUIRE(trees.contains_point(o, p) == any_object_holds(scene, p));
      }
    }
  }
  CHECK(inside > compared / 20);
  CHECK(inside < compared * 19 / 20);
}

TEST_CASE("De Morgan: a complement of a union is the intersection of the complements") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    INFO("seed " << seed);
    RandomModel random(seed);
    std::vector<CsgNode> parts, complements;
    for (std::size_t i = 2 + random.dice().below(3); i > 0; --i) {
      parts.push_back(transformed(random.leaf(random.dice().below(kLeafKinds)), random.map()));
      complements.push_back(operation(Operation::kComplement, {parts.back()}));
    }
    const auto compiled = [](CsgNode node) { return compile_scene(scene_of({std::move(node)})); };
    const auto complement = [](CsgNode node) {
      return operation(Operation::kComplement, {std::move(node)});
    };
    CHECK(compiled(complement(operation(Operation::kUnion, parts))) ==
          compiled(operation(Operation::kIntersection, complements)));
    CHECK(compiled(complement(operation(Operation::kIntersection, parts))) ==
          compiled(operation(Operation::kUnion, complements)));
    CHECK(compiled(complement(complement(parts[0]))) == compiled(parts[0]));
    // A − B − C is A ∧ ¬B ∧ ¬C.
    complements[0] = parts[0];
    CHECK(compiled(operation(Operation::kDifference, parts)) ==
          compiled(operation(Operation::kIntersection, complements)));
  }
}

TEST_CASE("the nearest material up the tree wins, and a reference passes its own on") {
  const CsgNode ball = node_of(SphereShape{{0, 0, 0}, 1});
  CsgNode painted = ball;
  painted.material = 2;
  CsgNode group = operation(Operation::kUnion, {ball, painted});
  group.material = 1;
  CsgNode use = node_of(ReferenceNode{0});
  use.material = 3;
  Scene scene = scene_of({operation(Operation::kUnion, {group, ball, use})});
  for (int i = 0; i < 3; ++i) scene.materials.push_back({"", {}});
  scene.shapes.push_back({"ball", ball});
  const Model model = compile_scene(scene);
  REQUIRE(model.primitives.size() == 4);
  CHECK(model.primitives[0].material == 1);
  CHECK(model.primitives[1].material == 2);
  CHECK(model.primitives[2].material == 0);
  CHECK(model.primitives[3].material == 3);
}
