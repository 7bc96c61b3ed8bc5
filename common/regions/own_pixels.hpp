// Own pixels: those whose primary rays a macro-region's node traces. Mostly they are the region's;
// where work is where pixels are, each row of the grid is cut by itself, so that nodes have as much
// to do as others.
//
// `own_edges`: pixel edges between the own pixels of a row's nodes, one fewer than columns for each
// row of the grid, strictly increasing in each. Empty: own pixels are those of the regions.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "regions/restrict.hpp"

namespace graycube {

/// Those between the own pixels of that row; `own_edges` are not empty.
std::span<const std::int64_t> own_edges_of_row(std::span<const std::int64_t> own_edges,
                                               const MacroGrid& grid, std::uint32_t row);

/// The region in the row of `region`, in which the pixel is, whose node traces the pixel's primary
/// rays.
RegionIndex owner_of_pixel(std::uint32_t x, RegionIndex region, const MacroGrid& grid,
                           std::span<const std::int64_t> own_edges);

/// What the own pixels of a region's node need of the scene beside the region itself; nothing where
/// they are in it.
std::optional<PicturePart> part_beside(RegionIndex region, const MacroGrid& grid,
                                       const CameraFrame& frame,
                                       std::span<const std::int64_t> own_edges);

/// What a share's macro-regions and own pixels need. Where own pixels are others than the regions',
/// the share has one region.
ModelContents contents_with_own_pixels(const Model& model, const MacroGrid& grid,
                                       const RegionShare& share,
                                       std::span<const std::int64_t> own_edges);

}  // namespace graycube
