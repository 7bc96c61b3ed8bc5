// Tiles: the rectangles of pixels that are handed out, accounted for and finished as one. The plan numbers
// them the same way in the frontal and in every node.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "space/macro_grid.hpp"

namespace graycube {

/// Side of a tile in pixels, where nothing else is asked for.
inline constexpr std::uint32_t kTileSide = 16;

struct TileShape {
  std::uint32_t width = kTileSide, height = kTileSide;
};

class TilePlan {
 public:
  /// The whole picture as one area, cut row by row.
  TilePlan(const ImageSize& image, TileShape shape);
  /// One area per macro-region, row by row; each area is cut by itself, so that a tile's primary rays all
  /// belong to one region.
  TilePlan(const ImageSize& image, TileShape shape, const MacroGrid& grid);

  std::uint32_t tile_count() const { return tile_count_; }
  std::uint64_t pixel_count() const { return std::uint64_t{image_.width} * image_.height; }
  PixelRect rect(std::uint32_t tile) const;
  std::uint32_t tile_of_pixel(std::uint32_t pixel) const;
  /// S × S primary rays a pixel.
  std::uint64_t primary_rays(std::uint32_t tile) const;

  /// Areas are numbered row · columns + column.
  std::uint32_t area_of_tile(std::uint32_t tile) const;
  /// The macro-region that all of a tile's primary rays belong to; {0, 0} where the picture is one area.
  RegionIndex region_of_tile(std::uint32_t tile) const;
  std::uint32_t first_tile(std::uint32_t area) const { return areas_[area].first_tile; }
  std::uint32_t tile_count_of(std::uint32_t area) const;
  /// The tiles of all areas of a share, area by area.
  std::vector<std::uint32_t> tiles_of(const RegionShare& share) const;

 private:
  struct Area {
    PixelRect rect;
    std::uint32_t first_tile = 0;
    std::uint32_t across = 0;
  };
  void add_area(const PixelRect& rect);

  ImageSize image_;
  TileShape shape_;
  std::uint32_t columns_ = 1;
  std::vector<Area> areas_;
  /// Area index of the column (row) of areas that each pixel column (row) belongs to.
  std::vector<std::uint16_t> column_of_x_, row_of_y_;
  std::uint32_t tile_count_ = 0;
};

}  // namespace graycube
