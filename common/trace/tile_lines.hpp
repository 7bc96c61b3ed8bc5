// The lines between tiles: where boundaries may slide to, so that no tile is ever cut in two.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "regions/rectilinear.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {

struct TileLines {
  /// The pixel edges at which tiles begin, strictly increasing from 0.
  std::vector<std::int64_t> columns, rows;

  /// The plan must be one of macro-regions, without own pixels.
  static TileLines of(const TilePlan& plan);

  /// Between which lines the tile that begins at this pixel lies.
  std::uint32_t column_of(std::uint32_t x) const;
  std::uint32_t row_of(std::uint32_t y) const;
  /// The boundaries as numbers of lines; nothing if one of them is no line inside the picture.
  std::optional<RectilinearCuts> cuts_of(const MacroGrid& grid) const;
  /// Whether there is a line that is no boundary.
  bool has_room(const RectilinearCuts& cuts) const {
    return columns.size() > cuts.columns.size() + 1 || rows.size() > cuts.rows.size() + 1;
  }
};

}  // namespace graycube
