// Rectilinear partition (Nicol 1994): a matrix of loads is cut by whole columns and whole rows so
// that the heaviest part is light.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace graycube {

/// Loads by cell, row by row; none negative.
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

/// Where parts begin, but for the first: strictly increasing, one fewer than parts.
struct RectilinearCuts {
  std::vector<std::uint32_t> columns, rows;
  friend bool operator==(const RectilinearCuts&, const RectilinearCuts&) = default;
};

/// As even as can be, by counting cells.
RectilinearCuts even_cuts(const LoadMap& map, std::uint32_t column_parts, std::uint32_t row_parts);
/// Cuts by columns with the rows' cuts fixed, and the other way round, in turn (each best for
/// itself). Never heavier than even_cuts. 1 ≤ parts ≤ cells, each way.
RectilinearCuts balanced_cuts(const LoadMap& map, std::uint32_t column_parts,
                              std::uint32_t row_parts);
/// The load of the heaviest part.
double heaviest(const LoadMap& map, const RectilinearCuts& cuts);

}  // namespace graycube
