#include "figures/macro_regions_figure.hpp"

#include <algorithm>

#include "figures/hypercube_figure.hpp"
#include "figures/page/page.hpp"

namespace graycube::figures {
namespace {

constexpr double kWidth = 760, kHeight = 740;
/// Labels are drawn where a region is at least so wide and so high on the page.
constexpr double kLeastLabelled = 15;

/// Boundaries of nodes' own pixels: in each row of the grid other ones.
void draw_own_pixels(Svg& svg, const ShownPicture& shown, const Picture& picture,
                     const control::GridLayout& grid) {
  if (grid.own_edges.empty()) return;
  const std::size_t per_row = grid.columns - 1;
  for (std::size_t row = 0; row < grid.rows; ++row) {
    const PixelSpan y = pixels_between(grid.row_edges, row, picture.height);
    for (std::size_t i = 0; i < per_row; ++i) {
      const auto x = static_cast<double>(grid.own_edges[row * per_row + i]);
      if (y.from >= y.to || x <= 0 || x >= picture.width) continue;
      svg.line(shown.at(x, y.from), shown.at(x, y.to),
               {.stroke = kOrange, .width = 2, .dashes = "6 4"});
    }
  }
}

void draw_labels(Svg& svg, const ShownPicture& shown, const Picture& picture, const Hypercube& cube,
                 const control::GridLayout& grid) {
  for (std::uint32_t row = 0; row < grid.rows; ++row) {
    for (std::uint32_t column = 0; column < grid.columns; ++column) {
      const PixelSpan x = pixels_between(grid.column_edges, column, picture.width);
      const PixelSpan y = pixels_between(grid.row_edges, row, picture.height);
      const Point a = shown.at(x.from, y.from), b = shown.at(x.to, y.to);
      const double room = std::min(b.x - a.x, b.y - a.y);
      if (x.from >= x.to || y.from >= y.to || room < kLeastLabelled) continue;
      const Rank rank = NodeMesh(cube).owner_of(column, row);
      const double size = std::clamp(room / 4, 8.0, 22.0);
      const Point at{(a.x + b.x) / 2, (a.y + b.y) / 2};
      svg.text({at.x, at.y + size * 0.1}, std::to_string(rank.value),
               {.size = size, .anchor = Anchor::kMiddle, .is_bold = true, .has_rim = true});
      if (room < 3 * size) continue;
      svg.text({at.x, at.y + size * 0.95}, bits_text(cube, cube.label_of(rank)),
               {.size = size * 0.62, .anchor = Anchor::kMiddle, .has_rim = true});
    }
  }
}

}  // namespace

PixelSpan pixels_between(const std::vector<std::int64_t>& edges, std::size_t i, double side) {
  const double from = i == 0 ? 0 : static_cast<double>(edges[i - 1]);
  const double to = i == edges.size() ? side : static_cast<double>(edges[i]);
  return {std::clamp(from, 0.0, side), std::clamp(to, 0.0, side)};
}

void draw_boundaries(Svg& svg, const ShownPicture& shown, const Picture& picture,
                     const control::GridLayout& grid) {
  const auto boundary = [&](Point a, Point b) {
    svg.line(a, b, {.stroke = kWhite, .width = 4});
    svg.line(a, b, {.stroke = kBlue, .width = 2});
  };
  for (const std::int64_t edge : grid.column_edges) {
    const auto x = static_cast<double>(edge);
    if (x > 0 && x < picture.width) boundary(shown.at(x, 0), shown.at(x, picture.height));
  }
  for (const std::int64_t edge : grid.row_edges) {
    const auto y = static_cast<double>(edge);
    if (y > 0 && y < picture.height) boundary(shown.at(0, y), shown.at(picture.width, y));
  }
}

std::string macro_regions_svg(std::string_view scene, const Picture& picture, const Hypercube& cube,
                              const control::GridLayout& grid, PartitionMode mode) {
  Svg svg = begin_page(kWidth, kHeight,
                       std::string(scene) + ": macro-regions of " + std::to_string(cube.nodes()) +
                           (cube.nodes() == 1 ? " node" : " nodes"),
                       std::to_string(grid.columns) + " \u00D7 " + std::to_string(grid.rows) +
                           " pyramids through the eye, " + std::string(to_string(mode)) +
                           " boundaries (report, figure 7)");
  const ShownPicture shown(picture, {kMargin, kHead, kWidth - 2 * kMargin, kHeight - 150});
  shown.draw(svg, 0.15);
  draw_boundaries(svg, shown, picture, grid);
  draw_own_pixels(svg, shown, picture, grid);
  draw_labels(svg, shown, picture, cube, grid);
  std::vector<LegendEntry> legend{{LegendEntry::Sign::kLine, kBlue, "boundary of macro-regions"}};
  if (!grid.own_edges.empty()) {
    legend.push_back(
        {LegendEntry::Sign::kDashes, kOrange, "boundary of pixels that nodes begin with"});
  }
  draw_legend(svg, {kMargin, kHeight - 50}, kWidth - 2 * kMargin, legend);
  svg.text(
      {kMargin, kHeight - 20},
      "In each region: the node's rank, and below it its Gray label. Neighbours' labels differ "
      "in one bit. Outer regions reach round to the back.",
      {.size = 12, .color = kQuiet});
  return svg.finish();
}

}  // namespace graycube::figures
