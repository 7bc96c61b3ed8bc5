// Figure 5 of the report: connectivity pointers of leaf regions.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "figures/leaf_space.hpp"
#include "figures/section_view.hpp"

namespace graycube::figures {

/// The connectivity pointer of one face of a leaf region.
struct Pointer {
  /// The leaf region's node, and the node that is pointed at: a leaf, or the root of the smallest
  /// subtree that touches the whole face.
  std::uint32_t leaf = 0, target = 0;
  /// On the page: 0 left, 1 right, 2 down, 3 up.
  int face = 0;
};

/// The pointers of a leaf region through the four faces that a section shows; faces with nothing
/// behind them have none.
std::vector<Pointer> pointers_of(const LeafSpace& space, const Section& section,
                                 std::uint32_t leaf);

/// The leaf regions whose pointers are drawn, the first one in the middle of the window.
struct PointersShown {
  Section section;
  Window window;
  std::vector<std::uint32_t> leaves;
};
inline constexpr std::size_t kLeavesWithPointers = 3;
PointersShown choose_pointers(const LeafSpace& space);

std::string pointers_svg(std::string_view scene, const LeafSpace& space);

}  // namespace graycube::figures
