// The subdivision itself: its regions share out space, their programs are the objects there, and
// neighbour links lead where the walk must go on.
#include "crossings/bsp.hpp"

#include <cmath>
#include <vector>

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "csg/tree.hpp"
#include "csg/whole_tree.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

const std::vector<BspOptions> kOptions{
    {}, {.step_cost = 0.01, .max_depth = 48}, {.step_cost = 0.6, .max_depth = 8}};

const BspLeaf& leaf_of(const Bsp& bsp, const Vec3& p, std::uint32_t node = 0) {
  for (;;) {
    const BspNode& n = bsp.nodes()[node];
    if (n.axis == BspNode::kLeafAxis) return bsp.leaves()[n.child];
    node = n.child + (p[n.axis] >= n.split ? 1u : 0u);
  }
}

/// Membership of a program at a point, by the tree that its shape stands for.
bool program_holds(const Bsp& bsp, const CellProgram& program, const Vec3& p) {
  const Model& model = bsp.model();
  const auto nodes = std::span(bsp.program_nodes()).subspan(program.first_node, program.node_count);
  const auto inside = [&](std::uint32_t i) {
    return contains(model.primitives[i], model.data(), p);
  };
  const auto literal = [&](const TreeNode& n) { return evaluate(std::span(&n, 1), inside); };
  switch (program.shape) {
    case CellProgram::Shape::kSingle:
    case CellProgram::Shape::kGeneral: return evaluate(nodes, inside);
    case CellProgram::Shape::kAllOf: return std::all_of(nodes.begin(), nodes.end(), literal);
    case CellProgram::Shape::kAnyOf: return std::any_of(nodes.begin(), nodes.end(), literal);
  }
  return false;
}

/// A point of a cell, near it where the cell is unbounded.
Vec3 point_in(const Aabb& cell, Dice& dice) {
  Vec3 p;
  for (int a = 0; a < 3; ++a) {
    const double lo = std::isfinite(cell.lo[a]) ? cell.lo[a] : std::fmin(cell.hi[a], 6) - 8;
    const double hi = std::isfinite(cell.hi[a]) ? cell.hi[a] : std::fmax(cell.lo[a], -6) + 8;
    p[a] = dice.between(lo, hi);
  }
  return p;
}

template <typename Check>
void for_random_bsps(std::uint64_t seeds, const Check& check) {
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const Model model = compile_scene(RandomModel(seed).scene());
    for (const BspOptions& options : kOptions) {
      INFO("seed " << seed << ", max_depth " << options.max_depth << ", step_cost "
                   << options.step_cost);
      const Bsp bsp = Bsp::build(model, options);
      Dice dice(seed);
      check(bsp, dice);
    }
  }
}

}  // namespace

TEST_CASE("every point lies in the cell of the region that the planes lead to") {
  for_random_bsps(300, [](const Bsp& bsp, Dice& dice) {
    for (int i = 0; i < 100; ++i) {
      const Vec3 p = dice.one_in(4) ? dice.grid_point(4)
                                    : std::pow(10, dice.between(-1, 4)) * dice.unit_vector();
      REQUIRE(leaf_of(bsp, p).cell.contains(p));
    }
  });
}

TEST_CASE("no two regions overlap") {
  for_random_bsps(100, [](const Bsp& bsp, Dice& dice) {
    for (int i = 0; i < 60; ++i) {
      const Vec3 p = dice.point(4);  // almost surely on no plane
      int holding = 0;
      for (const BspLeaf& leaf : bsp.leaves()) holding += leaf.cell.contains(p) ? 1 : 0;
      REQUIRE(holding == 1);
    }
  });
}

TEST_CASE("in its region a program has the membership of the whole object") {
  std::size_t programs = 0, constant = 0;
  for_random_bsps(400, [&](const Bsp& bsp, Dice& dice) {
    const WholeTrees trees(bsp.model());
    for (const BspLeaf& leaf : bsp.leaves()) {
      for (std::uint32_t o = 0; o < trees.object_count(); ++o) {
        const CellProgram* program = nullptr;
        for (std::uint32_t i = 0; i < leaf.program_count; ++i) {
          const CellProgram& candidate = bsp.programs()[leaf.first_program + i];
          if (candidate.object != o) continue;
          REQUIRE(program == nullptr);
          program = &candidate;
        }
        (program != nullptr ? programs : constant) += 1;
        const bool member = trees.contains_point(o, point_in(leaf.cell, dice));
        for (int k = 0; k < 12; ++k) {
          const Vec3 p = point_in(leaf.cell, dice);
          const bool expected = trees.contains_point(o, p);
          REQUIRE((program != nullptr ? program_holds(bsp, *program, p) : member) == expected);
        }
      }
    }
  });
  CHECK(programs > 10000);
  CHECK(constant > 10000);
}

TEST_CASE("programs are ordered by object and say what they hold") {
  for_random_bsps(300, [](const Bsp& bsp, Dice&) {
    for (const BspLeaf& leaf : bsp.leaves()) {
      for (std::uint32_t i = 0; i < leaf.program_count; ++i) {
        const CellProgram& program = bsp.programs()[leaf.first_program + i];
        if (i > 0) REQUIRE(bsp.programs()[leaf.first_program + i - 1].object < program.object);
        std::uint32_t literals = 0, nodes = 0;
        for (; nodes < program.node_count; ++nodes) {
          literals += bsp.program_nodes()[program.first_node + nodes].size == 1 ? 1 : 0;
        }
        REQUIRE(program.literals == literals);
        REQUIRE(literals > 0);
        const bool flat = program.shape != CellProgram::Shape::kGeneral;
        if (flat) REQUIRE(literals == nodes);
        REQUIRE((program.shape == CellProgram::Shape::kSingle) == (nodes == 1));
      }
    }
  });
}

TEST_CASE("a neighbour link leads to the region on the other side of the face") {
  std::size_t links = 0, outside = 0;
  for_random_bsps(300, [&](const Bsp& bsp, Dice& dice) {
    for (const BspLeaf& leaf : bsp.leaves()) {
      for (int face = 0; face < 6; ++face) {
        const int axis = face / 2;
        const double at = face % 2 == 1 ? leaf.cell.hi[axis] : leaf.cell.lo[axis];
        const std::uint32_t link = leaf.neighbour[static_cast<std::size_t>(face)];
        REQUIRE((link == kNoNeighbour) == !std::isfinite(at));
        if (link == kNoNeighbour) {
          ++outside;
          continue;
        }
        ++links;
        for (int k = 0; k < 4; ++k) {
          Vec3 p = point_in(leaf.cell, dice);
          p[axis] = face % 2 == 1 ? at : std::nextafter(at, -kInf);
          const BspLeaf& through_link = leaf_of(bsp, p, link);
          REQUIRE(through_link.cell.contains(p));
          REQUIRE(&through_link == &leaf_of(bsp, p));
          REQUIRE(&through_link != &leaf);
        }
      }
    }
  });
  CHECK(links > 10000);
  CHECK(outside > 1000);
}

TEST_CASE("subdividing keeps within its depth, and pays") {
  RandomModel random(3, {.coincidences = false, .unbounded = false});
  std::vector<CsgNode> small;
  for (int i = 0; i < 150; ++i) {
    CsgNode leaf = random.leaf(random.dice().below(kLeafKinds - 1));
    small.push_back(transformed(transformed(leaf, scaling({0.1, 0.1, 0.1})),
                                translation(random.dice().point(5))));
  }
  const Model model = compile_scene(scene_of(small));
  const Bsp bsp = Bsp::build(model);
  std::size_t programs = 0;
  for (const BspLeaf& leaf : bsp.leaves()) programs += leaf.program_count;
  CHECK(bsp.leaves().size() > model.objects.size());
  // On average a region holds far less than the scene.
  CHECK(programs < bsp.leaves().size() * 4);
  CHECK(bsp.memory_bytes() > bsp.nodes().size() * sizeof(BspNode));
  CHECK(Bsp::build(model, {.step_cost = 0.6, .max_depth = 6}).leaves().size() == 7);
}

TEST_CASE("holes that run through each other everywhere don't fill memory") {
  // Those of Menger's sponge: a region where three of the smallest meet is a region's worth of
  // work.
  std::vector<CsgNode> solids{node_of(BoxShape{{0, 0, 0}, {243, 243, 243}})};
  const auto drill = [&](const auto& again, double x, double y, double side) -> void {
    const double third = side / 3;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 lo{-1, -1, -1}, hi{244, 244, 244};
      lo[(axis + 1) % 3] = x + third;
      hi[(axis + 1) % 3] = x + 2 * third;
      lo[(axis + 2) % 3] = y + third;
      hi[(axis + 2) % 3] = y + 2 * third;
      solids.push_back(node_of(BoxShape{lo, hi}));
    }
    if (third < 2) return;
    for (int i = 0; i < 9; ++i) {
      if (i != 4) again(again, x + i % 3 * third, y + i / 3 * third, third);
    }
  };
  drill(drill, 0, 0, 243);
  CsgNode sponge;
  sponge.value = OperationNode{Operation::kDifference, std::move(solids)};
  const Model model = compile_scene(scene_of({sponge}));
  REQUIRE(model.primitives.size() == 1 + 3 * 4681);
  const Bsp bsp = Bsp::build_for_object(model, 0);
  std::size_t literals = 0;
  for (const CellProgram& program : bsp.programs()) literals += program.literals;
  CHECK(literals <= (std::size_t{1} << 18) + 16 * model.primitives.size());
  CHECK(bsp.leaves().size() > 10000);
}

TEST_CASE("a model without objects, or with nothing finite, is one region") {
  const Model empty = compile_scene(scene_of({}));
  CHECK(Bsp::build(empty).leaves().size() == 1);
  const Model floor = compile_scene(scene_of({node_of(HalfSpaceShape{{0, 1, 0.5}, 0})}));
  const Bsp bsp = Bsp::build(floor);
  REQUIRE(bsp.leaves().size() == 1);
  CHECK(bsp.leaves()[0].program_count == 1);
}
