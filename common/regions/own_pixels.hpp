// Own pixels of a macro-region's node are those whose primary rays it traces. Mostly they are the
// region's pixels; where rays stay where they begin, each row of the grid is cut by itself instead,
// so that all nodes have as much to do.
//
// `own_edges` are the pixel edges between the own pixels of a row's nodes: one fewer than columns
// for each row of the grid, strictly increasing in a row. If empty, own pixels are the regions'.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "regions/restrict.hpp"

namespace graycube {

/// The edges between the own pixels of one row of the grid; `own_edges` must not be empty.
std::span<const std::int64_t> own_edges_of_row(std::span<const std::int64_t> own_edges,
                                               const MacroGrid& grid, std::uint32_t row);

/// The region whose node traces a pixel's primary rays; it is in the row of `region`, the region
/// that holds the pixel.
RegionIndex owner_of_pixel(std::uint32_t x, RegionIndex region, const MacroGrid& grid,
                           std::span<const std::int64_t> own_edges);

/// The part of the picture in which a node has own pixels, if any of these lie outside its region;
/// nothing if all lie in it.
std::optional<PicturePart> part_beside(RegionIndex region, const MacroGrid& grid,
                                       const CameraFrame& frame,
                                       std::span<const std::int64_t> own_edges);

/// The part of a model that a share's macro-regions and own pixels need. If `own_edges` are not
/// empty, the share has a single region.
ModelContents contents_with_own_pixels(const Model& model, const MacroGrid& grid,
                                       const RegionShare& share,
                                       std::span<const std::int64_t> own_edges);

}  // namespace graycube
