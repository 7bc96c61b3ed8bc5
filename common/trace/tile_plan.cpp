#include "trace/tile_plan.hpp"

#include <algorithm>

#include "geometry/check.hpp"

namespace graycube {

TilePlan::TilePlan(const ImageSize& image, TileShape shape)
    : image_(image), shape_(shape), column_of_x_(image.width, 0), row_of_y_(image.height, 0) {
  add_area({0, 0, image.width, image.height});
}

TilePlan::TilePlan(const ImageSize& image, TileShape shape, const MacroGrid& grid)
    : image_(image), shape_(shape), columns_(grid.columns()) {
  for (std::uint32_t x = 0; x < image.width; ++x) {
    column_of_x_.push_back(grid.region_of_pixel(x, 0).column);
  }
  for (std::uint32_t y = 0; y < image.height; ++y) {
    row_of_y_.push_back(grid.region_of_pixel(0, y).row);
  }
  for (std::uint32_t row = 0; row < grid.rows(); ++row) {
    for (std::uint32_t column = 0; column < grid.columns(); ++column) {
      add_area(grid.pixels_of(
          {static_cast<std::uint16_t>(column), static_cast<std::uint16_t>(row)}));
    }
  }
}

void TilePlan::add_area(const PixelRect& rect) {
  Area area{rect, tile_count_, 0};
  if (!rect.is_empty()) {
    area.across = (rect.x1 - rect.x0 + shape_.width - 1) / shape_.width;
    tile_count_ += area.across * ((rect.y1 - rect.y0 + shape_.height - 1) / shape_.height);
  }
  areas_.push_back(area);
}

std::uint32_t TilePlan::tile_count_of(std::uint32_t area) const {
  const std::uint32_t end =
      area + 1 < areas_.size() ? areas_[area + 1].first_tile : tile_count_;
  return end - areas_[area].first_tile;
}

std::vector<std::uint32_t> TilePlan::tiles_of(const RegionShare& share) const {
  std::vector<std::uint32_t> tiles;
  for (std::uint32_t row = share.row; row * columns_ < areas_.size(); row += share.rows) {
    for (std::uint32_t column = share.column; column < columns_; column += share.columns) {
      const std::uint32_t area = row * columns_ + column;
      for (std::uint32_t i = 0; i < tile_count_of(area); ++i) tiles.push_back(first_tile(area) + i);
    }
  }
  return tiles;
}

std::uint32_t TilePlan::area_of_tile(std::uint32_t tile) const {
  GRAYCUBE_CHECK(tile < tile_count_, "tile %u of %u", tile, tile_count_);
  const auto after = std::upper_bound(areas_.begin(), areas_.end(), tile,
                                      [](std::uint32_t t, const Area& a) { return t < a.first_tile; });
  return static_cast<std::uint32_t>(after - areas_.begin() - 1);
}

RegionIndex TilePlan::region_of_tile(std::uint32_t tile) const {
  const std::uint32_t area = area_of_tile(tile);
  return {static_cast<std::uint16_t>(area % columns_), static_cast<std::uint16_t>(area / columns_)};
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
  const Area& area = areas_[row_of_y_[y] * columns_ + column_of_x_[x]];
  return area.first_tile + (y - area.rect.y0) / shape_.height * area.across +
         (x - area.rect.x0) / shape_.width;
}

std::uint64_t TilePlan::primary_rays(std::uint32_t tile) const {
  const PixelRect r = rect(tile);
  return std::uint64_t{r.x1 - r.x0} * (r.y1 - r.y0) * image_.samples * image_.samples;
}

}  // namespace graycube
