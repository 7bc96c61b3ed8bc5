// Where a node sits in the hypercube: whom it has across which bit, and who holds which macro-regions.
#pragma once

#include <cstdint>

#include "proto/share_of.hpp"
#include "space/macro_grid.hpp"
#include "topology/hypercube.hpp"

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
  Rank owner_of(const RegionIndex& region) const { return cube.owner_of(region.column, region.row); }
  /// The link across which a ray goes to another node's region.
  std::uint32_t bit_towards(const RegionIndex& region) const { return cube.first_bit(rank, owner_of(region)); }
  RegionShare share() const { return share_of(cube, rank); }
};

}  // namespace graycube
