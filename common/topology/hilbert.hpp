// Hilbert's curve through the cells of a square: cells with consecutive numbers touch, and every
// aligned block of 2^a numbers is a rectangle whose sides differ by a factor of 2 at most.
#pragma once

#include <cstdint>
#include <utility>

namespace graycube {

/// A cell of a square: 0 … side − 1 both ways.
struct HilbertCell {
  std::uint32_t column = 0, row = 0;

  /// Turns the curve in a square of that side as it lies in the quarter that `right` and `below`
  /// name. More bits of column and row than the side has are garbage.
  constexpr void turn(std::uint32_t side, bool right, bool below) {
    if (below) return;
    if (right) {
      column = side - 1 - column;
      row = side - 1 - row;
    }
    std::swap(column, row);
  }
};

/// The number of a cell on the curve from the square's first column to its last one, along row 0.
/// `side` is a power of two, 1 … 2^15.
constexpr std::uint32_t hilbert_number(std::uint32_t side, HilbertCell cell) {
  std::uint32_t number = 0;
  for (std::uint32_t half = side / 2; half > 0; half /= 2) {
    const bool right = (cell.column & half) != 0, below = (cell.row & half) != 0;
    number = number << 2 | ((right ? 3u : 0u) ^ (below ? 1u : 0u));
    cell.turn(side, right, below);
  }
  return number;
}

/// The inverse of hilbert_number().
constexpr HilbertCell hilbert_cell(std::uint32_t side, std::uint32_t number) {
  HilbertCell cell;
  for (std::uint32_t part = 1; part < side; part *= 2, number >>= 2) {
    const bool right = (number & 2) != 0, below = ((number & 1) != 0) != right;
    cell.turn(part, right, below);
    cell.column += right ? part : 0;
    cell.row += below ? part : 0;
  }
  return cell;
}

}  // namespace graycube
