#include "regions/own_pixels.hpp"

#include <algorithm>

namespace graycube {

std::span<const std::int64_t> own_edges_of_row(std::span<const std::int64_t> own_edges,
                                               const MacroGrid& grid, std::uint32_t row) {
  const std::size_t inner = grid.columns() - 1;
  return own_edges.subspan(row * inner, inner);
}

RegionIndex owner_of_pixel(std::uint32_t x, RegionIndex region, const MacroGrid& grid,
                           std::span<const std::int64_t> own_edges) {
  if (own_edges.empty()) return region;
  const auto edges = own_edges_of_row(own_edges, grid, region.row);
  const auto column = std::upper_bound(edges.begin(), edges.end(), std::int64_t{x}) - edges.begin();
  return {static_cast<std::uint16_t>(column), region.row};
}

std::optional<PicturePart> part_beside(RegionIndex region, const MacroGrid& grid,
                                       const CameraFrame& frame,
                                       std::span<const std::int64_t> own_edges) {
  if (own_edges.empty()) return std::nullopt;
  const std::int64_t width = frame.image.width;
  const auto edges = own_edges_of_row(own_edges, grid, region.row);
  // Both planes bound the part in front of the eye, and nothing of it lies behind. The first and
  // the last part may end anywhere beyond the picture.
  const std::int64_t begin = region.column > 0 ? edges[region.column - 1] : -1;
  const std::int64_t end = region.column < edges.size() ? edges[region.column] : width + 1;
  const PixelRect inside = grid.pixels_of(region);
  if (std::max<std::int64_t>(begin, 0) >= inside.x0 && std::min(end, width) <= inside.x1)
    return std::nullopt;
  return PicturePart{MacroGrid(frame, {begin, end}, grid.row_edges()), {1, region.row}};
}

ModelContents contents_with_own_pixels(const Model& model, const MacroGrid& grid,
                                       const RegionShare& share,
                                       std::span<const std::int64_t> own_edges) {
  const RegionIndex region{static_cast<std::uint16_t>(share.column),
                           static_cast<std::uint16_t>(share.row)};
  const auto frame = CameraFrame::from(model.settings.camera, model.settings.image);
  const auto beside = part_beside(region, grid, frame, own_edges);
  return contents_of_share(model, grid, share, beside ? &*beside : nullptr);
}

}  // namespace graycube
