#include "figures/pointers_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "figures/page/page.hpp"
#include "proto/messages/values.hpp"

namespace graycube::figures {
namespace {

constexpr double kWidth = 1000, kHeight = 720;
/// The window's sides, in sides of the leaf region at its middle.
constexpr double kAround = 1.7;
constexpr std::array<std::string_view, kLeavesWithPointers> kColors{kRed, kGreen, kViolet};

bool is_inside(const SectionCell& cell, const Window& w) {
  return cell.right_lo >= w.right_lo && cell.right_hi <= w.right_hi && cell.up_lo >= w.up_lo &&
         cell.up_hi <= w.up_hi;
}

double area(const SectionCell& cell) {
  return (cell.right_hi - cell.right_lo) * (cell.up_hi - cell.up_lo);
}

Window around(const SectionCell& cell, const Window& whole) {
  const double right = kAround * (cell.right_hi - cell.right_lo);
  const double up = kAround * (cell.up_hi - cell.up_lo);
  return {std::max(whole.right_lo, cell.right_lo - right),
          std::min(whole.right_hi, cell.right_hi + right), std::max(whole.up_lo, cell.up_lo - up),
          std::min(whole.up_hi, cell.up_hi + up)};
}

void draw_pointer(Svg& svg, const LeafSpace& space, const Section& section, const SectionView& view,
                  const Pointer& pointer, std::string_view color) {
  const SectionCell leaf = projected(space, section, pointer.leaf);
  const SectionCell target = projected(space, section, pointer.target);
  const Point from = view.face_middle(leaf, pointer.face);
  const Point to = view.shows(target) ? view.middle(target) : from;
  svg.circle(from, 3, {.fill = color});
  const double length = std::hypot(to.x - from.x, to.y - from.y);
  svg.arrow(from, to, {.stroke = color, .width = 2.2}, std::min(12.0, length / 8));
  const std::uint32_t leaves = space.leaves_below(pointer.target);
  if (leaves > 1 && view.shows(target)) {
    svg.text({to.x, to.y - 8}, "subtree of " + std::to_string(leaves),
             {.size = 11, .color = color, .anchor = Anchor::kMiddle, .has_rim = true});
  }
}

void draw_leaf(Svg& svg, const LeafSpace& space, const Section& section, const SectionView& view,
               std::uint32_t leaf, std::string_view color) {
  const auto pointers = pointers_of(space, section, leaf);
  for (const Pointer& p : pointers) {
    if (space.leaves_below(p.target) < 2) continue;
    svg.polygon(view.outline(projected(space, section, p.target)),
                {.stroke = color, .width = 2, .opacity = 0.7, .dashes = "7 4"});
  }
  svg.polygon(view.outline(projected(space, section, leaf)), {.fill = color, .opacity = 0.22});
  svg.polygon(view.outline(projected(space, section, leaf)), {.stroke = color, .width = 2.6});
}

}  // namespace

std::vector<Pointer> pointers_of(const LeafSpace& space, const Section& section,
                                 std::uint32_t leaf) {
  const Bsp& bsp = space.bsp();
  const BspLeaf& region = bsp.leaves()[bsp.nodes()[leaf].child];
  std::vector<Pointer> pointers;
  for (int face = 0; face < 4; ++face) {
    const int axis = face < 2 ? section.right : section.up;
    const std::uint32_t target = region.neighbour[static_cast<std::size_t>(axis * 2 + face % 2)];
    if (target != kNoNeighbour) pointers.push_back({leaf, target, face});
  }
  return pointers;
}

PointersShown choose_pointers(const LeafSpace& space) {
  PointersShown shown;
  shown.section = space.way() == Subdivision::kArnaldi ? fullest_section(space, 0, 2)
                                                       : fullest_section(space, 0, 1);
  const Window whole = whole_window(space, shown.section);
  auto cells = cells_in(space, shown.section);
  // Those that hold most first; of equal ones the largest.
  std::stable_sort(cells.begin(), cells.end(), [&](const SectionCell& a, const SectionCell& b) {
    const bool inside_a = is_inside(a, whole), inside_b = is_inside(b, whole);
    if (inside_a != inside_b) return inside_a;
    if (!inside_a) return false;
    return a.primitives != b.primitives ? a.primitives > b.primitives : area(a) > area(b);
  });
  shown.window = is_inside(cells.front(), whole) ? around(cells.front(), whole) : whole;
  shown.leaves.push_back(cells.front().node);
  // Beside it, the largest that the window shows whole.
  std::stable_sort(cells.begin(), cells.end(), [&](const SectionCell& a, const SectionCell& b) {
    const bool inside_a = is_inside(a, shown.window), inside_b = is_inside(b, shown.window);
    return inside_a != inside_b ? inside_a : inside_a && area(a) > area(b);
  });
  for (const SectionCell& cell : cells) {
    if (shown.leaves.size() == kLeavesWithPointers || !is_inside(cell, shown.window)) break;
    if (cell.node != shown.leaves.front()) shown.leaves.push_back(cell.node);
  }
  return shown;
}

std::string pointers_svg(std::string_view scene, const LeafSpace& space) {
  const PointersShown shown = choose_pointers(space);
  const auto cells = cells_in(space, shown.section);
  const SectionView view(space, shown.section, shown.window,
                         {kMargin, kHead, kWidth - 2 * kMargin, kHeight - 170});
  Svg svg = begin_page(
      kWidth, kHeight,
      std::string(scene) + ": connectivity pointers (" + std::string(to_string(space.way())) + ")",
      std::to_string(shown.leaves.size()) + " of " + count_text(space.bsp().leaves().size()) +
          " leaf regions, " + axes_text(space, shown.section) + " (report, figure 5)");
  svg.begin_clip(view.panel());
  view.draw_cells(svg, cells);
  for (std::size_t i = shown.leaves.size(); i-- > 0;) {
    draw_leaf(svg, space, shown.section, view, shown.leaves[i], kColors[i]);
  }
  for (std::size_t i = shown.leaves.size(); i-- > 0;) {
    for (const Pointer& p : pointers_of(space, shown.section, shown.leaves[i])) {
      draw_pointer(svg, space, shown.section, view, p, kColors[i]);
    }
  }
  svg.end_clip();
  svg.rectangle(view.panel(), {.stroke = kInk});
  draw_legend(
      svg, {kMargin, kHeight - 70}, kWidth - 2 * kMargin,
      {{LegendEntry::Sign::kArea, kScale[2], "leaf region: the darker, the more primitives"},
       {LegendEntry::Sign::kArrow, kRed, "pointer of a face, to a leaf region or a subtree"},
       {LegendEntry::Sign::kDashes, kRed, "the smallest subtree that touches the whole face"}});
  svg.text({kMargin, kHeight - 22},
           "Faces towards and away from the reader have pointers too. A ray that leaves through a "
           "face goes on from what its pointer names.",
           {.size = 12, .color = kQuiet});
  return svg.finish();
}

}  // namespace graycube::figures
