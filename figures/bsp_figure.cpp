#include "figures/bsp_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "figures/page/page.hpp"
#include "figures/page/shown_picture.hpp"
#include "figures/screen_regions.hpp"
#include "figures/section_view.hpp"

namespace graycube::figures {
namespace {

constexpr double kWidth = 760, kHeight = 760, kWideWidth = 1040;
/// Counts are written where a region is at least so wide and so high on the page.
constexpr double kLeastLabelled = 17;

void draw_shades(Svg& svg, Point at, std::uint32_t most, std::string_view what) {
  for (std::size_t i = 0; i < kScale.size(); ++i) {
    svg.rectangle({at.x + 26.0 * static_cast<double>(i), at.y, 26, 14},
                  {.fill = kScale[i], .stroke = kQuiet, .width = 0.4});
  }
  const double end = at.x + 26.0 * kScale.size();
  svg.text({at.x, at.y + 28}, "1", {.size = 11, .color = kQuiet});
  svg.text({end, at.y + 28}, std::to_string(std::max(most, 1u)),
           {.size = 11, .color = kQuiet, .anchor = Anchor::kEnd});
  svg.text({end + 12, at.y + 12}, what, {.size = 12, .color = kQuiet});
}

/// One path for each shade keeps drawings of thousands of regions small.
void draw_regions(Svg& svg, const ShownPicture& shown, const std::vector<ScreenRegion>& regions,
                  std::uint32_t most, double width, double height) {
  std::array<std::string, kScale.size() + 1> paths;
  std::vector<std::pair<Point, std::string>> counts;
  for (const ScreenRegion& r : regions) {
    const Point a = shown.at(std::max(r.x0, 0.0), std::max(r.y0, 0.0));
    const Point b = shown.at(std::min(r.x1, width), std::min(r.y1, height));
    if (!(a.x < b.x && a.y < b.y)) continue;
    paths[shade_of(r.primitives, most)] += "M" + coordinate(a.x) + " " + coordinate(a.y) + "H" +
                                           coordinate(b.x) + "V" + coordinate(b.y) + "H" +
                                           coordinate(a.x) + "Z";
    if (r.primitives > 0 && std::min(b.x - a.x, b.y - a.y) >= kLeastLabelled) {
      counts.push_back({{(a.x + b.x) / 2, (a.y + b.y) / 2 + 4}, std::to_string(r.primitives)});
    }
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].empty()) continue;
    if (i > 0) svg.path(paths[i], {.fill = kScale[i - 1], .opacity = 0.5});
    svg.path(paths[i], {.stroke = kInk, .width = 0.7, .opacity = 0.8});
  }
  for (const auto& [at, count] : counts) {
    svg.text(at, count, {.size = 11, .anchor = Anchor::kMiddle, .has_rim = true});
  }
}

std::string screen_svg(std::string_view scene, const Picture& picture, const LeafSpace& space) {
  const auto regions = screen_regions_of(space);
  std::uint32_t most = 0, empty = 0;
  for (const ScreenRegion& r : regions) {
    most = std::max(most, r.primitives);
    if (r.primitives == 0) ++empty;
  }
  Svg svg =
      begin_page(kWidth, kHeight, std::string(scene) + ": the screen cut by a BSP (arnaldi)",
                 count_text(regions.size()) + " regions of the screen, " + count_text(empty) +
                     " of them empty; cut in depth into " +
                     count_text(space.bsp().leaves().size()) + " leaf regions (report, figure 4)");
  const ShownPicture shown(picture, {kMargin, kHead, kWidth - 2 * kMargin, kHeight - 150});
  shown.draw(svg, 0.35);
  draw_regions(svg, shown, regions, most, picture.width, picture.height);
  draw_shades(svg, {kMargin, kHeight - 58}, most,
              "primitives held in depth; a region without colour holds none: no ray is shot");
  return svg.finish();
}

/// The axis most along a direction.
int nearest_axis(const Vec3& v) {
  const double x = std::fabs(v.x), y = std::fabs(v.y), z = std::fabs(v.z);
  return x >= y && x >= z ? 0 : y >= z ? 1 : 2;
}

std::string linked_svg(std::string_view scene, const Picture& picture, const LeafSpace& space) {
  // As the camera sees it: what is most along its own upward direction goes up.
  const int across = nearest_axis(space.frame().forward);
  const Vec3 down = space.frame().down;
  int up = nearest_axis(down);
  if (up == across) up = across == 2 ? 1 : 2;
  const Section section = fullest_section(space, 3 - across - up, up);
  const auto cells = cells_in(space, section);
  std::uint32_t most = 0;
  for (const SectionCell& cell : cells) most = std::max(most, cell.primitives);
  Svg svg =
      begin_page(kWideWidth, 620, std::string(scene) + ": space cut by a BSP (linked)",
                 count_text(space.bsp().leaves().size()) + " leaf regions, " +
                     count_text(cells.size()) + " of them in this " + axes_text(space, section));
  const ShownPicture shown(picture, {kMargin, kHead, 380, 440});
  shown.draw(svg, 0);
  const SectionView view(space, section, whole_window(space, section),
                         {kMargin + 410, kHead, kWideWidth - 2 * kMargin - 410, 440});
  view.draw_cells(svg, cells);
  svg.rectangle(view.panel(), {.stroke = kInk});
  draw_shades(svg, {kMargin, 556}, most, "primitives that a leaf region holds");
  return svg.finish();
}

}  // namespace

std::string bsp_svg(std::string_view scene, const Picture& picture, const LeafSpace& space) {
  return space.way() == Subdivision::kArnaldi ? screen_svg(scene, picture, space)
                                              : linked_svg(scene, picture, space);
}

}  // namespace graycube::figures
