// Figure 7 of the report: the screen cut into macro-regions, over the picture.
#pragma once

#include <string>
#include <string_view>

#include "figures/page/shown_picture.hpp"
#include "film/film.hpp"
#include "proto/messages.hpp"
#include "topology/node_mesh.hpp"

namespace graycube::figures {

/// The boundaries of a grid that lie in the picture, and the node of each of its regions.
void draw_boundaries(Svg& svg, const ShownPicture& shown, const Picture& picture,
                     const control::GridLayout& grid);

/// The pixels of column (or row) number i, given the inner edges: from, to, cut at the picture's
/// sides; from ≥ to if it has none.
struct PixelSpan {
  double from = 0, to = 0;
  double middle() const { return (from + to) / 2; }
};
PixelSpan pixels_between(const std::vector<std::int64_t>& edges, std::size_t i, double side);

std::string macro_regions_svg(std::string_view scene, const Picture& picture, const Hypercube& cube,
                              const control::GridLayout& grid, PartitionMode mode);

}  // namespace graycube::figures
