#include "figures/section_view.hpp"

#include <algorithm>
#include <cmath>

#include "figures/page/page.hpp"

namespace graycube::figures {
namespace {

/// What is shown beyond the extent, as a share of it.
constexpr double kBeyond = 0.08;

}  // namespace

Window whole_window(const LeafSpace& space, const Section& section) {
  const Aabb& e = space.extent();
  const double r = kBeyond * (e.hi[section.right] - e.lo[section.right]);
  const double u = kBeyond * (e.hi[section.up] - e.lo[section.up]);
  Window window{e.lo[section.right] - r, e.hi[section.right] + r, e.lo[section.up] - u,
                e.hi[section.up] + u};
  if (space.is_fan() && section.up == 2) window.up_lo = 0;
  return window;
}

std::string axes_text(const LeafSpace& space, const Section& section) {
  const char* names = "xyz";
  const auto name = [&](int axis) {
    const std::string letter(1, names[axis]);
    return space.is_fan() && axis < 2 ? letter + "/z" : letter;
  };
  // What rounding leaves of 0 is 0 to the reader.
  const double at = std::fabs(section.at) < 1e-9 ? 0 : section.at;
  const std::string where = name(section.across) + " = " + figure_text(at);
  if (space.way() == Subdivision::kLinked) {
    return "section at " + where + ": " + name(section.right) + " to the right, " +
           name(section.up) + " up, in units of the scene";
  }
  return "section at " + where + " of the camera's space: " + name(section.right) +
         " to the right, depth z up";
}

SectionView::SectionView(const LeafSpace& space, const Section& section, const Window& window,
                         const Box& panel)
    : section_(section),
      window_(window),
      panel_(panel),
      is_fan_(space.is_fan() && section.up == 2),
      x_lo_(window.right_lo),
      x_hi_(window.right_hi) {
  if (!is_fan_) return;
  x_lo_ = std::min(window.right_lo * window.up_lo, window.right_lo * window.up_hi);
  x_hi_ = std::max(window.right_hi * window.up_lo, window.right_hi * window.up_hi);
}

Point SectionView::at(double right, double up) const {
  const double x = is_fan_ ? right * up : right;
  return {panel_.x + (x - x_lo_) / (x_hi_ - x_lo_) * panel_.width,
          panel_.bottom() - (up - window_.up_lo) / (window_.up_hi - window_.up_lo) * panel_.height};
}

SectionCell SectionView::clipped(const SectionCell& cell) const {
  SectionCell c = cell;
  c.right_lo = std::max(c.right_lo, window_.right_lo);
  c.right_hi = std::min(c.right_hi, window_.right_hi);
  c.up_lo = std::max(c.up_lo, window_.up_lo);
  c.up_hi = std::min(c.up_hi, window_.up_hi);
  return c;
}

bool SectionView::shows(const SectionCell& cell) const {
  const SectionCell c = clipped(cell);
  return c.right_lo < c.right_hi && c.up_lo < c.up_hi;
}

std::vector<Point> SectionView::outline(const SectionCell& cell) const {
  if (!shows(cell)) return {};
  const SectionCell c = clipped(cell);
  return {at(c.right_lo, c.up_lo), at(c.right_hi, c.up_lo), at(c.right_hi, c.up_hi),
          at(c.right_lo, c.up_hi)};
}

Point SectionView::middle(const SectionCell& cell) const {
  const SectionCell c = clipped(cell);
  return at((c.right_lo + c.right_hi) / 2, (c.up_lo + c.up_hi) / 2);
}

Point SectionView::face_middle(const SectionCell& cell, int face) const {
  const SectionCell c = clipped(cell);
  const double right = (c.right_lo + c.right_hi) / 2, up = (c.up_lo + c.up_hi) / 2;
  switch (face) {
    case 0: return at(c.right_lo, up);
    case 1: return at(c.right_hi, up);
    case 2: return at(right, c.up_lo);
    default: return at(right, c.up_hi);
  }
}

void SectionView::draw_cells(Svg& svg, const std::vector<SectionCell>& cells) const {
  // One path for each shade keeps drawings of thousands of cells small.
  std::vector<std::string> paths(kScale.size());
  double most = 0;
  for (const SectionCell& cell : cells) most = std::max(most, double{1} * cell.primitives);
  for (const SectionCell& cell : cells) {
    const auto corners = outline(cell);
    if (corners.empty()) continue;
    std::string& path = paths[shade_of(cell.primitives, most)];
    for (std::size_t i = 0; i < corners.size(); ++i) {
      path += (i == 0 ? "M" : "L") + coordinate(corners[i].x) + " " + coordinate(corners[i].y);
    }
    path += "Z";
  }
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (paths[i].empty()) continue;
    svg.path(paths[i],
             {.fill = i == 0 ? kPanel : kScale[i - 1], .stroke = "#8896a6", .width = 0.6});
  }
}

}  // namespace graycube::figures
