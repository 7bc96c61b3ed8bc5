#include "trace/tile_plan.hpp"

#include <algorithm>

#include "check.hpp"
#include "regions/own_pixels.hpp"

namespace graycube {

TilePlan::TilePlan(const ImageSize& image, TileShape shape)
    : image_(image),
      shape_(shape),
      first_areas_{0},
      row_of_y_(image.height, 0),
      place_of_x_(image.width, 0) {
  add_area({0, 0, image.width, image.height}, {}, {});
}

TilePlan::TilePlan(const ImageSize& image, TileShape shape, const MacroGrid& grid,
                   std::span<const std::int64_t> own_edges)
    : image_(image), shape_(shape), is_jagged_(!own_edges.empty()) {
  GRAYCUBE_CHECK(own_edges.empty() || own_edges.size() == (grid.columns() - 1) * grid.rows(),
                 "%zu edges", own_edges.size());
  for (std::uint32_t y = 0; y < image.height; ++y) {
    row_of_y_.push_back(grid.region_of_pixel(0, y).row);
  }
  for (std::uint32_t x = 0; x < image.width && !is_jagged_; ++x) {
    place_of_x_.push_back(grid.region_of_pixel(x, 0).column);
  }
  for (std::uint16_t row = 0; row < grid.rows(); ++row) {
    first_areas_.push_back(static_cast<std::uint32_t>(areas_.size()));
    if (is_jagged_) {
      add_jagged_row(grid, row, own_edges);
      continue;
    }
    for (std::uint16_t column = 0; column < grid.columns(); ++column) {
      const RegionIndex region{column, row};
      add_area(grid.pixels_of(region), region, region);
    }
  }
}

/// Adds the areas of one row: an area ends where its macro-region or its owner changes.
void TilePlan::add_jagged_row(const MacroGrid& grid, std::uint16_t row,
                              std::span<const std::int64_t> own_edges) {
  std::vector<std::uint32_t> ends{image_.width};
  for (const std::span<const std::int64_t> edges :
       {std::span(grid.column_edges()), own_edges_of_row(own_edges, grid, row)}) {
    for (const std::int64_t edge : edges) {
      if (edge > 0 && edge < image_.width) ends.push_back(static_cast<std::uint32_t>(edge));
    }
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  const PixelRect pixels = grid.pixels_of({0, row});
  std::uint32_t began = 0;
  std::uint16_t areas = 0;
  for (const std::uint32_t end : ends) {
    const RegionIndex region{grid.region_of_pixel(began, 0).column, row};
    add_area({began, pixels.y0, end, pixels.y1}, region,
             owner_of_pixel(began, region, grid, own_edges));
    place_of_x_.insert(place_of_x_.end(), end - began, areas++);
    began = end;
  }
}

void TilePlan::add_area(const PixelRect& rect, RegionIndex region, RegionIndex owner) {
  Area area{rect, region, owner, tile_count_, 0};
  if (!rect.is_empty()) {
    area.across = (rect.x1 - rect.x0 + shape_.width - 1) / shape_.width;
    tile_count_ += area.across * ((rect.y1 - rect.y0 + shape_.height - 1) / shape_.height);
  }
  areas_.push_back(area);
}

const TilePlan::Area& TilePlan::area_at(std::uint32_t x, std::uint32_t y) const {
  const std::uint32_t row = row_of_y_[y];
  const std::size_t first = is_jagged_ ? std::size_t{row} * image_.width : 0;
  return areas_[first_areas_[row] + place_of_x_[first + x]];
}

std::uint32_t TilePlan::tile_count_of(std::uint32_t area) const {
  const std::uint32_t end = area + 1 < areas_.size() ? areas_[area + 1].first_tile : tile_count_;
  return end - areas_[area].first_tile;
}

std::vector<std::uint32_t> TilePlan::tiles_of(const RegionShare& share) const {
  std::vector<std::uint32_t> tiles;
  if (!share.owns_slab(0)) return tiles;
  for (std::size_t row = share.row; row < first_areas_.size(); row += share.rows) {
    const std::size_t end = row + 1 < first_areas_.size() ? first_areas_[row + 1] : areas_.size();
    for (std::uint32_t area = first_areas_[row]; area < end; ++area) {
      if (!share.owns_column(areas_[area].owner.column)) continue;
      for (std::uint32_t i = 0; i < tile_count_of(area); ++i) tiles.push_back(first_tile(area) + i);
    }
  }
  return tiles;
}

std::uint32_t TilePlan::area_of_tile(std::uint32_t tile) const {
  GRAYCUBE_CHECK(tile < tile_count_, "tile %u of %u", tile, tile_count_);
  const auto after =
      std::upper_bound(areas_.begin(), areas_.end(), tile,
                       [](std::uint32_t t, const Area& a) { return t < a.first_tile; });
  return static_cast<std::uint32_t>(after - areas_.begin() - 1);
}

PixelRect TilePlan::rect(std::uint32_t tile) const {
  const Area& area = areas_[area_of_tile(tile)];
  const std::uint32_t i = tile - area.first_tile;
  const std::uint32_t x0 = area.rect.x0 + i % area.across * shape_.width;
  const std::uint32_t y0 = area.rect.y0 + i / area.across * shape_.height;
  return {x0, y0, std::min(x0 + shape_.width, area.rect.x1),
          std::min(y0 + shape_.height, area.rect.y1)};
}

std::uint32_t TilePlan::tile_of_pixel(std::uint32_t pixel) const {
  const std::uint32_t x = pixel % image_.width;
  const std::uint32_t y = pixel / image_.width;
  const Area& area = area_at(x, y);
  return area.first_tile + (y - area.rect.y0) / shape_.height * area.across +
         (x - area.rect.x0) / shape_.width;
}

std::uint64_t TilePlan::primary_rays(std::uint32_t tile) const {
  const PixelRect r = rect(tile);
  return std::uint64_t{r.x1 - r.x0} * (r.y1 - r.y0) * image_.samples * image_.samples;
}

}  // namespace graycube
