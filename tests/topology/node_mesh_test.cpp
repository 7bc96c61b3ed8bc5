#include "topology/node_mesh.hpp"

#include <set>
#include <tuple>
#include <vector>

#include "catch.hpp"

namespace graycube {
namespace {

constexpr MeshMode kModes[] = {MeshMode::k2d, MeshMode::k3d, MeshMode::kRing, MeshMode::kTree};

template <class Check>
void for_each_mesh(std::uint32_t most_nodes, Check&& check) {
  for (std::uint32_t nodes = 1; nodes <= most_nodes; nodes *= 2) {
    for (const MeshMode mode : kModes) {
      const NodeMesh mesh(*Hypercube::of_size(nodes), mode);
      INFO("mesh " << static_cast<int>(mode) << " of " << nodes);
      check(mesh, mode);
    }
  }
}

bool are_linked_or_same(const NodeMesh& mesh, Rank a, Rank b) {
  return a == b || mesh.cube().link_between(a, b).has_value();
}

std::vector<std::uint32_t> sides(std::uint32_t nodes, MeshMode mode) {
  const NodeMesh mesh(*Hypercube::of_size(nodes), mode);
  return {mesh.columns(), mesh.rows(), mesh.slabs()};
}

using Sides = std::vector<std::uint32_t>;

TEST_CASE("the bits of labels are shared out among columns, rows and slabs") {
  CHECK(sides(8, MeshMode::k2d) == Sides{4, 2, 1});
  CHECK(sides(8, MeshMode::kTree) == Sides{4, 2, 1});
  CHECK(sides(8, MeshMode::kRing) == Sides{8, 1, 1});
  CHECK(sides(1, MeshMode::k3d) == Sides{1, 1, 1});
  CHECK(sides(2, MeshMode::k3d) == Sides{2, 1, 1});
  CHECK(sides(4, MeshMode::k3d) == Sides{2, 2, 1});
  CHECK(sides(8, MeshMode::k3d) == Sides{2, 2, 2});
  CHECK(sides(16, MeshMode::k3d) == Sides{4, 2, 2});
  CHECK(sides(32, MeshMode::k3d) == Sides{4, 4, 2});
  CHECK(sides(64, MeshMode::k3d) == Sides{4, 4, 4});
  CHECK(sides(1024, MeshMode::k3d) == Sides{16, 8, 8});
}

TEST_CASE("each node has one place in a mesh, and the first node the first place") {
  for_each_mesh(kMaxNodes, [](const NodeMesh& mesh, MeshMode mode) {
    CHECK(mesh.columns() * mesh.rows() * mesh.slabs() == mesh.cube().nodes());
    CHECK(mesh.place_of(Rank{0}) == NodeMesh::Place{0, 0, 0});
    std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> places;
    for (std::uint32_t r = 0; r < mesh.cube().nodes(); ++r) {
      const auto [column, row, slab] = mesh.place_of(Rank{r});
      REQUIRE(places.emplace(column, row, slab).second);
      REQUIRE(mesh.owner_of(column, row, slab) == Rank{r});
      // Ranks are numbered by the columns and rows of two-dimensional meshes.
      const bool is_2d = mode == MeshMode::k2d || mode == MeshMode::kTree;
      if (is_2d) REQUIRE(mesh.cube().rank_at(column, row) == Rank{r});
    }
  });
}

TEST_CASE("neighbours in each direction of a mesh, scattered or not, are linked or the same node") {
  for_each_mesh(64, [](const NodeMesh& mesh, MeshMode) {
    for (const std::uint32_t scatter : {1u, 2u, 3u}) {
      const std::uint32_t columns = scatter * mesh.columns(), rows = scatter * mesh.rows();
      for (std::uint32_t slab = 0; slab < mesh.slabs(); ++slab) {
        for (std::uint32_t row = 0; row < rows; ++row) {
          for (std::uint32_t column = 0; column < columns; ++column) {
            const Rank here = mesh.owner_of(column, row, slab);
            // Columns and rows go round; slabs are an open line.
            const Rank right = mesh.owner_of((column + 1) % columns, row, slab);
            const Rank below = mesh.owner_of(column, (row + 1) % rows, slab);
            REQUIRE(are_linked_or_same(mesh, here, right));
            REQUIRE(are_linked_or_same(mesh, here, below));
            if (slab + 1 == mesh.slabs()) continue;
            const Rank behind = mesh.owner_of(column, row, slab + 1);
            REQUIRE(here != behind);
            REQUIRE(are_linked_or_same(mesh, here, behind));
          }
        }
      }
    }
  });
}

TEST_CASE("a ring's columns are the token's ring") {
  for (std::uint32_t nodes = 1; nodes <= kMaxNodes; nodes *= 2) {
    const NodeMesh mesh(*Hypercube::of_size(nodes), MeshMode::kRing);
    for (std::uint32_t column = 0; column < nodes; ++column) {
      REQUIRE(mesh.cube().ring_next(mesh.owner_of(column, 0)) ==
              mesh.owner_of((column + 1) % nodes, 0));
    }
  }
}

TEST_CASE("a scattered grid gives every node as many macro-regions") {
  const NodeMesh mesh(*Hypercube::of_size(8));
  std::vector<int> held(8);
  for (std::uint32_t row = 0; row < 6; ++row) {
    for (std::uint32_t column = 0; column < 12; ++column) ++held[mesh.owner_of(column, row).value];
  }
  CHECK(held == std::vector<int>(8, 9));
  CHECK(mesh.owner_of(5, 3) == mesh.cube().rank_at(1, 1));
}

}  // namespace
}  // namespace graycube
