#include "figures/entry_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "figures/page/page.hpp"
#include "figures/section_view.hpp"

namespace graycube::figures {
namespace {

constexpr double kWidth = 1000, kHeight = 720;
/// Points at which a ray is looked up, since a fan bends it.
constexpr int kRayPoints = 240;
/// What is shown around the way, as a share of its size.
constexpr double kAround = 0.18;

constexpr std::array<std::string_view, kRayKinds> kKindNames{"primary", "shadow", "reflected",
                                                             "refracted"};

/// The place of a point of the ray in the coordinates of the space.
Vec3 place_on(const LeafSpace& space, const Ray& ray, double t) {
  const Vec3 p = ray.origin + t * ray.direction;
  if (space.way() == Subdivision::kLinked) return p;
  const Vec3 q = space.camera_space().place_of(p);
  return space.is_fan() ? Vec3{q.x / q.z, q.y / q.z, q.z} : q;
}

/// The axes on which the way's cells differ most: from above or from the side for `arnaldi`.
Section section_at(const LeafSpace& space, const Vec3& place,
                   const std::vector<std::uint32_t>& way) {
  const auto changes = [&](int axis) {
    std::size_t n = 0;
    for (std::size_t i = 1; i < way.size(); ++i) {
      const Aabb &a = space.cell(way[i - 1]), &b = space.cell(way[i]);
      if (a.hi[axis] <= b.lo[axis] || b.hi[axis] <= a.lo[axis]) ++n;
    }
    return n;
  };
  Section section;
  if (space.way() == Subdivision::kArnaldi) {
    section = changes(0) >= changes(1) ? Section{0, 2, 1, 0} : Section{1, 2, 0, 0};
  } else {
    const std::size_t x = changes(0), y = changes(1), z = changes(2);
    section = x <= y && x <= z   ? Section{1, 2, 0, 0}
              : y <= x && y <= z ? Section{0, 2, 1, 0}
                                 : Section{0, 1, 2, 0};
  }
  section.at = place[section.across];
  return section;
}

/// A window around the entry and all faces of the way's cells that are in the whole window; where a
/// cell lies beside that, its nearest face.
Window window_around(const LeafSpace& space, const Section& section, const Vec3& place,
                     const std::vector<std::uint32_t>& way) {
  const Window whole = whole_window(space, section);
  Window w{place[section.right], place[section.right], place[section.up], place[section.up]};
  const auto include = [](double from, double to, double lo, double hi, double& least,
                          double& most) {
    for (const double face : {from, to}) {
      const bool is_nearest = (face == from && from >= hi) || (face == to && to <= lo);
      if ((face < lo || face > hi) && !is_nearest) continue;
      least = std::min(least, face);
      most = std::max(most, face);
    }
  };
  for (const std::uint32_t node : way) {
    const SectionCell c = projected(space, section, node);
    include(c.right_lo, c.right_hi, whole.right_lo, whole.right_hi, w.right_lo, w.right_hi);
    include(c.up_lo, c.up_hi, whole.up_lo, whole.up_hi, w.up_lo, w.up_hi);
  }
  const double right =
      std::max(kAround * (w.right_hi - w.right_lo), 0.05 * (whole.right_hi - whole.right_lo));
  const double up = std::max(kAround * (w.up_hi - w.up_lo), 0.05 * (whole.up_hi - whole.up_lo));
  w = {w.right_lo - right, w.right_hi + right, w.up_lo - up, w.up_hi + up};
  if (space.is_fan()) w.up_lo = std::max(w.up_lo, 0.0);
  return w;
}

/// The ray from where it begins to where its node got it, or from there on.
void draw_ray(Svg& svg, const ShownEntry& entry, const SectionView& view, bool is_after) {
  const RayTask& task = entry.received.ray;
  const double reach = std::isfinite(task.t_max) ? task.t_max : task.t + std::max(4 * task.t, 10.0);
  const double from = is_after ? task.t : 0, to = is_after ? reach : task.t;
  std::vector<Point> points;
  for (int i = 0; i <= kRayPoints; ++i) {
    const Vec3 p = place_on(*entry.space, task.ray, from + (to - from) * i / kRayPoints);
    if (entry.space->is_fan() && !(p.z > 0)) continue;
    points.push_back(view.at(p));
  }
  svg.polyline(points, {.stroke = kOrange, .width = 2.4, .dashes = is_after ? "" : "6 4"});
}

/// The subtrees that links lead to, as far as they are more than the next leaf region.
void draw_subtrees(Svg& svg, const ShownEntry& entry, const Section& section,
                   const SectionView& view) {
  for (std::size_t i = 1; i < entry.way.size(); ++i) {
    const std::uint32_t node = subtree_between(*entry.space, entry.way[i - 1], entry.way[i]);
    const std::uint32_t leaves = entry.space->leaves_below(node);
    const SectionCell cell = projected(*entry.space, section, node);
    const auto outline = view.outline(cell);
    if (leaves < 2 || outline.empty()) continue;
    svg.polygon(outline, {.fill = kRed, .opacity = 0.05});
    svg.polygon(outline, {.stroke = kRed, .width = 2.4, .dashes = "8 5"});
    const Point top{(outline[2].x + outline[3].x) / 2, outline[2].y + 18};
    svg.text(top, "subtree of " + std::to_string(leaves) + " leaf regions",
             {.size = 12, .color = kRed, .anchor = Anchor::kMiddle, .has_rim = true});
  }
}

void draw_way(Svg& svg, const ShownEntry& entry, const Section& section, const SectionView& view) {
  std::vector<Point> middles;
  for (std::size_t i = 0; i < entry.way.size(); ++i) {
    const SectionCell cell = projected(*entry.space, section, entry.way[i]);
    const bool is_last = i + 1 == entry.way.size();
    const std::string_view color = is_last ? kGreen : kRed;
    const auto outline = view.outline(cell);
    svg.polygon(outline, {.fill = color, .opacity = is_last ? 0.3 : 0.12});
    svg.polygon(outline, {.stroke = color, .width = 2});
    Point middle = outline.empty() ? Point{-100, -100} : view.middle(cell);
    // Cells one behind the other in the section have one middle.
    for (const Point& other : middles) {
      if (std::hypot(other.x - middle.x, other.y - middle.y) < 24) middle.x += 34;
    }
    middles.push_back(middle);
  }
  for (std::size_t i = 1; i < middles.size(); ++i) {
    const Point a = middles[i - 1], b = middles[i];
    const double length = std::max(std::hypot(b.x - a.x, b.y - a.y), 1.0);
    const double share = std::max(0.5, 1 - 11 / length);
    svg.arrow(a, {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)},
              {.stroke = kRed, .width = 2}, std::min(10.0, length / 8));
  }
  for (std::size_t i = 0; i < middles.size(); ++i) {
    const bool is_last = i + 1 == middles.size();
    svg.circle(middles[i], 10, {.fill = is_last ? kGreen : kRed, .stroke = kWhite, .width = 1.5});
    svg.text({middles[i].x, middles[i].y + 4}, std::to_string(i + 1),
             {.size = 12, .color = kWhite, .anchor = Anchor::kMiddle, .is_bold = true});
  }
}

std::string subtitle_of(const ShownEntry& entry, const Section& section) {
  const ReceivedRay& r = entry.received;
  return "A " + std::string(kKindNames[static_cast<std::size_t>(r.ray.kind)]) + " ray from node " +
         std::to_string(r.from.value) + " is in one of the " +
         count_text(entry.space->bsp().leaves().size()) + " leaf regions of node " +
         std::to_string(r.at.value) + "; " + axes_text(*entry.space, section);
}

}  // namespace

std::string entry_svg(std::string_view scene, const ShownEntry& entry) {
  const LeafSpace& space = *entry.space;
  const Vec3 place = place_on(space, entry.received.ray.ray, entry.received.ray.t);
  const Section section = section_at(space, place, entry.way);
  const SectionView view(space, section, window_around(space, section, place, entry.way),
                         {kMargin, kHead, kWidth - 2 * kMargin, kHeight - 170});
  const std::size_t links = entry.way.size() - 1;
  Svg svg = begin_page(kWidth, kHeight,
                       std::string(scene) + ": the entry region, " + std::to_string(links) +
                           (links == 1 ? " link" : " links") + " from the outermost leaf region",
                       subtitle_of(entry, section));
  svg.begin_clip(view.panel());
  view.draw_cells(svg, cells_in(space, section));
  draw_subtrees(svg, entry, section, view);
  draw_way(svg, entry, section, view);
  draw_ray(svg, entry, view, false);
  draw_ray(svg, entry, view, true);
  const Point at = view.at(place);
  svg.circle(at, 6, {.fill = kOrange, .stroke = kInk, .width = 1.5});
  svg.end_clip();
  svg.rectangle(view.panel(), {.stroke = kInk});
  draw_legend(
      svg, {kMargin, kHeight - 70}, kWidth - 2 * kMargin,
      {{LegendEntry::Sign::kDashes, kOrange, "the ray before it came to the node"},
       {LegendEntry::Sign::kLine, kOrange, "the ray from there on"},
       {LegendEntry::Sign::kDot, kOrange, "where it is when it arrives"},
       {LegendEntry::Sign::kArea, kGreen, "its entry region"},
       {LegendEntry::Sign::kArrow, kRed, "links followed from the outermost leaf region"},
       {LegendEntry::Sign::kDashes, kRed, "what a link leads to: only planes in it are compared"}});
  svg.text({kMargin, kHeight - 16},
           "Leaf regions on the way lie in depth, too; here they are seen one behind the other. "
           "Report, figure 8.",
           {.size = 12, .color = kQuiet});
  return svg.finish();
}

}  // namespace graycube::figures
