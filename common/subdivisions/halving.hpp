// Cutting cells in halves until little is left in them: which cells, and where it ends.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

#include "crossings/cell_programs.hpp"

namespace graycube {

/// A cell with so few primitives is a leaf region: to go on from one cell to the next, a ray passes
/// about ten planes on its way down from the root, which costs it as much as a few primitives do.
inline constexpr std::size_t kFewPrimitives = 6;
/// The most times that a cell is halved along each axis, whatever the model.
inline constexpr int kMostHalvings = 12;
/// How many primitives all cells together hold at most: so many for each of the model's, and more.
/// Models come near to it only where very many surfaces are close together everywhere.
inline constexpr std::size_t kMostCopies = 64;
inline constexpr std::size_t kMoreCopies = std::size_t{1} << 16;

/// How often space is halved along each axis. Where n primitives are spread evenly, log₈ n halvings
/// give each a cell of its own; a few more follow their surfaces.
inline int halvings_for(std::size_t primitives) {
  constexpr int kMore = 3;
  return std::min(kMostHalvings, static_cast<int>(std::bit_width(primitives) + 2) / 3 + kMore);
}

/// A cell that waits to be cut or closed.
struct HalvedCell {
  /// What the subdivision calls the cell.
  std::uint64_t place;
  Aabb box;
  /// How often space was cut to get here.
  int depth;
  CellContent content;
};

/// Cuts `root` and what comes of it, larger cells first, so that where the limit of primitives is
/// reached all cells end at the same size. `cut(cell, add)` calls `add(part)` for the cell's parts,
/// `parts` at most; `close(cell)` makes it a leaf region. Cells aren't deeper than `max_depth`.
template <typename Cut, typename Close>
void halve(HalvedCell root, std::size_t parts, int max_depth, Cut&& cut, Close&& close) {
  std::size_t held = root.content.literal_count();
  const std::size_t most = kMostCopies * held + kMoreCopies;
  std::deque<HalvedCell> waiting;
  waiting.push_back(std::move(root));
  for (; !waiting.empty(); waiting.pop_front()) {
    HalvedCell& cell = waiting.front();
    const std::size_t own = cell.content.literal_count();
    if (cell.depth >= max_depth || own <= kFewPrimitives || held - own + parts * own > most) {
      close(cell);
      continue;
    }
    held -= own;
    cut(cell, [&](HalvedCell part) {
      held += part.content.literal_count();
      waiting.push_back(std::move(part));
    });
  }
}

}  // namespace graycube
