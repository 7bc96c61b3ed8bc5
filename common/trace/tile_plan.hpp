// Tiles are the rectangles of pixels that are handed out, accounted for and finished as one. The
// plan numbers them the same way in the frontal and in every node.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "regions/macro_grid.hpp"

namespace graycube {

/// Default side of a tile in pixels.
inline constexpr std::uint32_t kTileSide = 16;

struct TileShape {
  std::uint32_t width = kTileSide, height = kTileSide;
};

class TilePlan {
 public:
  /// The whole picture as one area, cut row by row.
  TilePlan(const ImageSize& image, TileShape shape);
  /// One area per macro-region, row by row; each area is cut by itself, so that a tile's primary
  /// rays all belong to one region. If nodes have own pixels (own_pixels.hpp), areas also end where
  /// these end.
  TilePlan(const ImageSize& image, TileShape shape, const MacroGrid& grid,
           std::span<const std::int64_t> own_edges = {});

  std::uint32_t tile_count() const { return tile_count_; }
  std::uint64_t pixel_count() const { return std::uint64_t{image_.width} * image_.height; }
  PixelRect rect(std::uint32_t tile) const;
  std::uint32_t tile_of_pixel(std::uint32_t pixel) const;
  /// The number of a tile's primary rays: samples × samples for each pixel.
  std::uint64_t primary_rays(std::uint32_t tile) const;

  /// Areas are numbered row · columns + column if each is a macro-region's (no own edges).
  std::uint32_t area_of_tile(std::uint32_t tile) const;
  /// The macro-region that all of a tile's primary rays belong to; {0, 0} if the picture is a
  /// single area.
  RegionIndex region_of_tile(std::uint32_t tile) const { return areas_[area_of_tile(tile)].region; }
  /// The macro-region whose node traces the tile's primary rays.
  RegionIndex owner_of_tile(std::uint32_t tile) const { return areas_[area_of_tile(tile)].owner; }
  std::uint32_t first_tile(std::uint32_t area) const { return areas_[area].first_tile; }
  std::uint32_t tile_count_of(std::uint32_t area) const;
  /// The tiles that a share's node traces, area by area; none where it has no region in the first
  /// slab, in which all primary rays begin.
  std::vector<std::uint32_t> tiles_of(const RegionShare& share) const;

 private:
  struct Area {
    PixelRect rect;
    RegionIndex region, owner;
    std::uint32_t first_tile = 0;
    std::uint32_t across = 0;
  };
  void add_area(const PixelRect& rect, RegionIndex region, RegionIndex owner);
  void add_jagged_row(const MacroGrid& grid, std::uint16_t row,
                      std::span<const std::int64_t> own_edges);
  const Area& area_at(std::uint32_t x, std::uint32_t y) const;

  ImageSize image_;
  TileShape shape_;
  std::vector<Area> areas_;
  /// The number of the first area of each row of areas.
  std::vector<std::uint32_t> first_areas_;
  /// The row of areas that each pixel row belongs to; and the place of each pixel column in its row
  /// of areas: one list for all rows, or, if jagged, one list after the other for each row.
  std::vector<std::uint16_t> row_of_y_, place_of_x_;
  bool is_jagged_ = false;
  std::uint32_t tile_count_ = 0;
};

}  // namespace graycube
