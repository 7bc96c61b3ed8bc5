// A node of a hierarchy of boxes, eight of them side by side.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace graycube {

/// Up to eight boxes side by side. Unused places hold empty boxes.
struct alignas(64) WideNode {
  static constexpr std::size_t kWidth = 8;
  static constexpr std::uint32_t kItemFlag = 0x80000000u;

  /// [0]: lower, [1]: upper sides, by axis.
  std::array<std::array<std::array<float, kWidth>, 3>, 2> planes{};
  /// Inner: index of a node; with kItemFlag: of an item.
  std::array<std::uint32_t, kWidth> child{};
};

}  // namespace graycube
