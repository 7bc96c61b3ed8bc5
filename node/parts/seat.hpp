// Where a node sits in the hypercube: which neighbour is across which bit, and who owns which
// macro-regions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "proto/share_of.hpp"
#include "regions/macro_grid.hpp"
#include "topology/node_mesh.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

struct Seat {
  Hypercube cube;
  Rank rank;
  /// How the job's macro-regions lie on the hypercube.
  MeshMode mode = MeshMode::k2d;

  NodeMesh mesh() const { return {cube, mode}; }
  std::uint32_t links() const { return cube.dimension(); }
  Rank peer(std::uint32_t bit) const { return cube.neighbour(rank, bit); }
  /// The bit of the link to `peer`; links() for a rank that is no neighbour.
  std::uint32_t bit_of(Rank peer) const {
    return cube.has(peer) ? cube.link_between(rank, peer).value_or(links()) : links();
  }
  Rank owner_of(const RegionIndex& region) const {
    return mesh().owner_of(region.column, region.row, region.slab);
  }
  /// Whether all these rays are in that node's regions.
  bool owns_all(Rank owner, std::span<const RayTask> rays) const {
    return std::ranges::all_of(rays,
                               [&](const RayTask& ray) { return owner_of(ray.region) == owner; });
  }
  /// The link across which a ray goes to another node's region.
  std::uint32_t bit_towards(const RegionIndex& region) const {
    return cube.first_bit(rank, owner_of(region));
  }
  /// The link for a ray that was traced here for a neighbour, `owner`, and goes on to `next`. It
  /// crosses the bit that it would have crossed from the owner: the node there is a neighbour of
  /// `next` if the owner is, and sends it on. So the busy owner has no part in it.
  std::uint32_t bit_for_helped(Rank owner, Rank next) const {
    return cube.first_bit(rank, next, bit_of(owner));
  }
  RegionShare share_of(Rank owner) const { return graycube::share_of(mesh(), owner); }
  RegionShare share() const { return share_of(rank); }
};

}  // namespace graycube
