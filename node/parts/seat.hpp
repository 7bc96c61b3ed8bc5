// Where a node sits in the hypercube: whom it has across which bit, and who holds which
// macro-regions.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "proto/share_of.hpp"
#include "regions/macro_grid.hpp"
#include "topology/hypercube.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

struct Seat {
  Hypercube cube;
  Rank rank;

  std::uint32_t links() const { return cube.dimension(); }
  Rank peer(std::uint32_t bit) const { return cube.neighbour(rank, bit); }
  /// links() for a rank that is no neighbour.
  std::uint32_t bit_of(Rank peer) const {
    return cube.has(peer) ? cube.link_between(rank, peer).value_or(links()) : links();
  }
  Rank owner_of(const RegionIndex& region) const {
    return cube.owner_of(region.column, region.row);
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
  /// What is traced here for a neighbour goes on to another node. If that is a neighbour of the
  /// owner, it crosses the bit that it would have crossed from there: who is beyond is a neighbour
  /// of the node that it goes to, and sends it on. So the owner, which is busy, has no part in it.
  std::uint32_t bit_for_helped(Rank owner, Rank next) const {
    return cube.first_bit(rank, next, bit_of(owner));
  }
  RegionShare share() const { return share_of(cube, rank); }
};

}  // namespace graycube
