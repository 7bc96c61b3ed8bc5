#pragma once

#include <compare>
#include <cstdint>

namespace graycube {

/// A node's number, 0 … nodes − 1. Neighbours in the grid mostly have near ones: hilbert.hpp.
struct Rank {
  std::uint32_t value = 0;
  friend constexpr auto operator<=>(const Rank&, const Rank&) = default;
};

/// A node's corner of the hypercube: nodes whose labels differ in one bit are linked.
struct GrayLabel {
  std::uint32_t value = 0;
  friend constexpr auto operator<=>(const GrayLabel&, const GrayLabel&) = default;
};

}  // namespace graycube
