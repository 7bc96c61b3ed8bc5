#include "node/parts/seat.hpp"

#include "catch.hpp"
#include "node/sent_mail.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

const Hypercube kCube = *Hypercube::of_size(16);

RayTask ray_in(std::uint16_t column, std::uint16_t row) {
  RayTask ray = shadow_ray();
  ray.region = {column, row};
  return ray;
}

}  // namespace

TEST_CASE("each link of a seat leads to the neighbour across its bit, and no other rank has one") {
  for (std::uint32_t rank = 0; rank < kCube.nodes(); ++rank) {
    const Seat seat{kCube, Rank{rank}};
    std::uint32_t linked = 0;
    for (std::uint32_t other = 0; other < kCube.nodes() + 2; ++other) {
      const std::uint32_t bit = seat.bit_of(Rank{other});
      if (bit == seat.links()) continue;
      ++linked;
      CHECK(seat.peer(bit) == Rank{other});
    }
    CHECK(linked == 4);
  }
}

TEST_CASE("a ray on its way to a region gets there, one link nearer each time") {
  for (std::uint32_t from = 0; from < kCube.nodes(); ++from) {
    for (std::uint16_t column = 0; column < 8; ++column) {
      const RegionIndex goal{column, 5};
      Rank at{from};
      std::uint32_t links = 0;
      for (; at != Seat{kCube, at}.owner_of(goal); ++links) {
        const Seat seat{kCube, at};
        at = seat.peer(seat.bit_towards(goal));
      }
      CHECK(links <= kCube.dimension());
    }
  }
}

TEST_CASE("a seat's share of the grid is the regions that it owns") {
  for (std::uint32_t rank = 0; rank < kCube.nodes(); ++rank) {
    const Seat seat{kCube, Rank{rank}};
    for (std::uint16_t column = 0; column < 8; ++column) {
      for (std::uint16_t row = 0; row < 8; ++row) {
        const RegionIndex region{column, row};
        CHECK(seat.share().owns(region) == (seat.owner_of(region) == seat.rank));
      }
    }
  }
}

TEST_CASE("rays are all of a node's regions unless one of them is not") {
  const Seat seat{kCube, Rank{0}};
  const Rank owner = seat.owner_of({1, 2});
  // The grid is four by four nodes, so the fifth column belongs to the same nodes as the first.
  CHECK(seat.owns_all(owner, std::vector{ray_in(1, 2), ray_in(5, 6)}));
  CHECK_FALSE(seat.owns_all(owner, std::vector{ray_in(1, 2), ray_in(2, 2)}));
  CHECK(seat.owns_all(owner, {}));
}

TEST_CASE(
    "what is traced for a neighbour leaves across the bit by which it would have left there") {
  const Seat helper{kCube, Rank{0}};
  for (std::uint32_t bit = 0; bit < helper.links(); ++bit) {
    const Rank owner = helper.peer(bit);
    const Seat owners{kCube, owner};
    for (std::uint32_t away = 0; away < owners.links(); ++away) {
      const Rank next = owners.peer(away);
      if (next != helper.rank) CHECK(helper.bit_for_helped(owner, next) == away);
    }
  }
}
