// Rectilinear partition (Nicol 1994): a matrix of loads is cut by whole columns and whole rows so
// that the heaviest part is light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace graycube {

/// The load of each cell of a grid, row by row; none is negative.
struct LoadMap {
  std::uint32_t columns = 1, rows = 1;
  std::vector<double> load;

  LoadMap(std::uint32_t c, std::uint32_t r) : columns(c), rows(r), load(std::size_t{c} * r, 0) {}
  double& at(std::uint32_t column, std::uint32_t row) {
    return load[std::size_t{row} * columns + column];
  }
  double at(std::uint32_t column, std::uint32_t row) const {
    return load[std::size_t{row} * columns + column];
  }
};

/// The cells at which all parts but the first begin, strictly increasing: one fewer than parts.
struct RectilinearCuts {
  std::vector<std::uint32_t> columns, rows;
  friend bool operator==(const RectilinearCuts&, const RectilinearCuts&) = default;
};

/// Cuts into parts of numbers of cells that are as equal as can be.
RectilinearCuts even_cuts(const LoadMap& map, std::uint32_t column_parts, std::uint32_t row_parts);
/// Cuts columns with the rows' cuts fixed, then rows with the columns' cuts fixed, in turn (each in
/// the best way). Never heavier than even_cuts(). 1 ≤ parts ≤ cells, each way.
RectilinearCuts balanced_cuts(const LoadMap& map, std::uint32_t column_parts,
                              std::uint32_t row_parts);
/// The load of the heaviest part.
double heaviest(const LoadMap& map, const RectilinearCuts& cuts);

}  // namespace graycube
