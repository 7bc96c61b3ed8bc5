// A node of a hierarchy of boxes, eight of them side by side.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/float_box.hpp"

namespace graycube {

/// Up to eight boxes side by side. Unused places hold empty boxes.
struct alignas(64) WideNode {
  static constexpr std::size_t kWidth = 8;
  static constexpr std::uint32_t kItemFlag = 0x80000000u;

  /// The boxes' lower sides [0] and upper sides [1], indexed by axis and place.
  std::array<std::array<std::array<float, kWidth>, 3>, 2> planes{};
  /// The index of each place's node, or, with kItemFlag, of its item.
  std::array<std::uint32_t, kWidth> child{};

  void set_box(std::size_t place, const FloatBox& box) {
    for (std::size_t a = 0; a < 3; ++a) {
      planes[0][a][place] = box.lo[a];
      planes[1][a][place] = box.hi[a];
    }
  }
  FloatBox box(std::size_t place) const {
    FloatBox box;
    for (std::size_t a = 0; a < 3; ++a) {
      box.lo[a] = planes[0][a][place];
      box.hi[a] = planes[1][a][place];
    }
    return box;
  }
  bool is_used(std::size_t place) const { return !(planes[0][0][place] > planes[1][0][place]); }
  bool is_item(std::size_t place) const { return (child[place] & kItemFlag) != 0; }
  /// The index of the item in a place; there must be one.
  std::uint32_t item(std::size_t place) const { return child[place] & ~kItemFlag; }
};

}  // namespace graycube
