// Jagged partition: a picture is cut into rows, and each row into columns of its own, so that all
// parts are about equally heavy.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "regions/rectilinear.hpp"

namespace graycube {

/// Cuts lie at multiples of this many pixels, so that packets of primary rays are full.
inline constexpr std::int64_t kCutStep = 4;

/// Pixel edges between parts, each strictly increasing and inside the picture.
struct JaggedCuts {
  std::vector<std::int64_t> rows;
  /// Edges of the first row of parts, then of the second and so on: one fewer than columns a row.
  std::vector<std::int64_t> columns;
};

/// `x` and `y`: the pixel edges of the map's cells, from 0 to the picture's sides, one more than
/// cells. The load of a cell counts as spread evenly over its pixels. 1 ≤ parts ≤ pixels, each way.
JaggedCuts jagged_cuts(const LoadMap& map, std::span<const std::int64_t> x,
                       std::span<const std::int64_t> y, std::uint32_t column_parts,
                       std::uint32_t row_parts);

/// For each column but the last, the mean over all rows of the edge where it ends.
std::vector<std::int64_t> mean_columns(const JaggedCuts& cuts, std::uint32_t column_parts);

}  // namespace graycube
