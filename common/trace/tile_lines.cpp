#include "trace/tile_lines.hpp"

#include <algorithm>
#include <span>

namespace graycube {
namespace {

void sort_out(std::vector<std::int64_t>& lines) {
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
}

std::uint32_t place_of(const std::vector<std::int64_t>& lines, std::int64_t edge) {
  return static_cast<std::uint32_t>(std::lower_bound(lines.begin(), lines.end(), edge) -
                                    lines.begin());
}

/// Appends the numbers of the lines at these edges. False if one of them is no line, or line 0.
bool add_cuts(const std::vector<std::int64_t>& lines, const std::vector<std::int64_t>& edges,
              std::vector<std::uint32_t>& cuts) {
  for (const std::int64_t edge : edges) {
    const std::uint32_t place = place_of(lines, edge);
    if (place == 0 || place == lines.size() || lines[place] != edge) return false;
    cuts.push_back(place);
  }
  return true;
}

}  // namespace

TileLines TileLines::of(const TilePlan& plan) {
  TileLines lines;
  for (std::uint32_t tile = 0; tile < plan.tile_count(); ++tile) {
    const PixelRect rect = plan.rect(tile);
    lines.columns.push_back(rect.x0);
    lines.rows.push_back(rect.y0);
  }
  sort_out(lines.columns);
  sort_out(lines.rows);
  return lines;
}

std::uint32_t TileLines::column_of(std::uint32_t x) const { return place_of(columns, x); }

std::uint32_t TileLines::row_of(std::uint32_t y) const { return place_of(rows, y); }

std::optional<RectilinearCuts> TileLines::cuts_of(const MacroGrid& grid) const {
  RectilinearCuts cuts;
  if (!add_cuts(columns, grid.column_edges(), cuts.columns) ||
      !add_cuts(rows, grid.row_edges(), cuts.rows)) {
    return std::nullopt;
  }
  return cuts;
}

}  // namespace graycube
