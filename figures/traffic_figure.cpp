#include "figures/traffic_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "figures/macro_regions_figure.hpp"
#include "figures/page/page.hpp"
#include "figures/page/shown_picture.hpp"
#include "figures/traffic.hpp"
#include "regions/camera.hpp"

namespace graycube::figures {
namespace {

constexpr double kWidth = 1120, kHeight = 690;
constexpr Box kMap{kMargin, kHead + 6, 500, 500};
constexpr std::size_t kParts = 56, kMostLinks = 20;
constexpr double kWidestArrow = 9;

/// Where nodes are on the map: at their regions' middles, or evenly in columns and rows where these
/// are many or not all in the picture.
std::vector<Point> node_places(const ShownPicture& shown, const Picture& picture,
                               const Hypercube& cube, const control::GridLayout& grid) {
  bool is_even = grid.columns != cube.columns() || grid.rows != cube.rows();
  const auto middle = [&](const std::vector<std::int64_t>& edges, std::uint32_t i, double side) {
    const PixelSpan span = pixels_between(edges, i, side);
    if (span.from >= span.to) is_even = true;
    return span.middle();
  };
  std::vector<Point> places, even;
  for (std::uint32_t r = 0; r < cube.nodes(); ++r) {
    const std::uint32_t column = cube.column_of(Rank{r}), row = cube.row_of(Rank{r});
    even.push_back(shown.at((column + 0.5) / cube.columns() * picture.width,
                            (row + 0.5) / cube.rows() * picture.height));
    if (is_even) continue;
    const double x = middle(grid.column_edges, column, picture.width);
    const double y = middle(grid.row_edges, row, picture.height);
    places.push_back(shown.at(x, y));
  }
  return is_even ? even : places;
}

/// A light's place in the picture, in pixels; nothing behind the eye.
std::optional<Point> place_of_light(const CameraFrame& frame, const Vec3& light) {
  const Vec3 q = light - frame.eye;
  const double z = dot(q, frame.forward);
  const bool is_fan = frame.projection == Projection::kPerspective;
  if (is_fan && !(z > 0)) return std::nullopt;
  const double scale = frame.pixel_size * (is_fan ? z : 1);
  return Point{dot(q, frame.right) / scale + 0.5 * frame.image.width,
               dot(q, frame.down) / scale + 0.5 * frame.image.height};
}

void draw_star(Svg& svg, Point at) {
  std::vector<Point> corners;
  for (int i = 0; i < 16; ++i) {
    const double angle = i * std::acos(-1.0) / 8, radius = i % 2 == 0 ? 13 : 6;
    corners.push_back({at.x + radius * std::cos(angle), at.y + radius * std::sin(angle)});
  }
  svg.polygon(corners, {.fill = kGold, .stroke = kInk, .width = 1});
}

/// Lights, those outside of the picture at its edge; returns whether any is behind the eye.
bool draw_lights(Svg& svg, const ShownPicture& shown, const RenderSettings& settings) {
  const CameraFrame frame = CameraFrame::from(settings.camera, settings.image);
  bool has_hidden = false;
  for (const PointLight& light : settings.lights) {
    const auto place = place_of_light(frame, light.position);
    if (!place) {
      has_hidden = true;
      continue;
    }
    draw_star(svg, shown.at(std::clamp(place->x, 0.0, 1.0 * settings.image.width),
                            std::clamp(place->y, 0.0, 1.0 * settings.image.height)));
  }
  return has_hidden;
}

void draw_ways(Svg& svg, const Hypercube& cube, const std::vector<Point>& places,
               const std::vector<LinkTraffic>& links) {
  const double most = links.empty() ? 1 : static_cast<double>(links.front().rays);
  // The busiest last, on top.
  for (std::size_t i = links.size(); i-- > 0;) {
    const LinkTraffic& link = links[i];
    const Point a = places[link.from.value], b = places[link.to.value];
    const double length = std::max(std::hypot(b.x - a.x, b.y - a.y), 1.0);
    const double gap = std::min(15.0, length / 3);
    const Point u{(b.x - a.x) / length, (b.y - a.y) / length};
    const auto apart = [](std::uint32_t p, std::uint32_t q) { return p > q ? p - q : q - p; };
    const bool is_far = apart(cube.column_of(link.from), cube.column_of(link.to)) > 1 ||
                        apart(cube.row_of(link.from), cube.row_of(link.to)) > 1;
    const double width = 0.6 + kWidestArrow * static_cast<double>(link.rays) / most;
    svg.arrow({a.x + gap * u.x, a.y + gap * u.y}, {b.x - gap * u.x, b.y - gap * u.y},
              {.stroke = is_far ? kViolet : kRed, .width = width, .opacity = 0.75},
              is_far ? 26 : std::min(9.0, length / 8));
  }
}

void draw_nodes(Svg& svg, const std::vector<Point>& places,
                const std::vector<std::uint64_t>& received) {
  const double most = static_cast<double>(*std::max_element(received.begin(), received.end()));
  for (std::size_t r = 0; r < places.size(); ++r) {
    const std::size_t shade = shade_of(static_cast<double>(received[r]), most);
    svg.circle(places[r], places.size() > 16 ? 10 : 14,
               {.fill = kScale[shade], .stroke = kInk, .width = 1.2});
    svg.text({places[r].x, places[r].y + 4}, std::to_string(r),
             {.size = 12,
              .color = shade > 3 ? kWhite : kInk,
              .anchor = Anchor::kMiddle,
              .is_bold = true});
  }
}

/// Cells of one shade are one path, so that drawings stay small.
using ShadePaths = std::array<std::string, kScale.size()>;

/// A row of the table of traffic over time; its cells are added to `paths`.
void draw_row(Svg& svg, const Box& row, std::string_view name, const LinkTraffic& link, double most,
              ShadePaths& paths) {
  svg.text({row.x - 8, row.center().y + 4}, name, {.size = 11, .anchor = Anchor::kEnd});
  const double width = row.width / static_cast<double>(link.over_time.size());
  for (std::size_t i = 0; i < link.over_time.size(); ++i) {
    const std::size_t shade = shade_of(static_cast<double>(link.over_time[i]), most);
    if (shade == 0) continue;
    paths[shade] += "M" + coordinate(row.x + width * static_cast<double>(i)) + " " +
                    coordinate(row.y) + "h" + coordinate(width) + "v" + coordinate(row.height) +
                    "h" + coordinate(-width) + "z";
  }
  svg.text({row.right() + 8, row.center().y + 4}, count_text(link.rays),
           {.size = 11, .color = kQuiet});
}

std::uint64_t busiest_part(const LinkTraffic& link) {
  return *std::max_element(link.over_time.begin(), link.over_time.end());
}

/// The sum of links from number `first` on.
LinkTraffic sum_of(const std::vector<LinkTraffic>& links, std::size_t first) {
  LinkTraffic sum;
  sum.over_time.resize(kParts);
  for (std::size_t i = first; i < links.size(); ++i) {
    sum.rays += links[i].rays;
    for (std::size_t p = 0; p < kParts; ++p) sum.over_time[p] += links[i].over_time[p];
  }
  return sum;
}

void draw_table(Svg& svg, const RunRecord& run, const std::vector<LinkTraffic>& links) {
  const Box table{640, kHead + 32, 370, 460};
  const std::size_t shown = links.size() > kMostLinks ? kMostLinks - 1 : links.size();
  const std::size_t rows = shown + 1 + (links.size() > shown ? 1 : 0);
  const double height = std::min(24.0, table.height / static_cast<double>(rows));
  std::uint64_t most = 1;
  for (std::size_t i = 0; i < shown; ++i) most = std::max(most, busiest_part(links[i]));
  Box row{table.x, table.y, table.width, height - 4};
  ShadePaths paths;
  const auto add = [&](const std::string& name, const LinkTraffic& link, std::uint64_t largest) {
    draw_row(svg, row, name, link, static_cast<double>(largest), paths);
    row.y += height;
  };
  svg.text({table.x - 8, table.y - 10}, "link",
           {.size = 11, .color = kQuiet, .anchor = Anchor::kEnd});
  svg.text({table.right() + 8, table.y - 10}, "rays", {.size = 11, .color = kQuiet});
  for (std::size_t i = 0; i < shown; ++i) {
    const LinkTraffic& link = links[i];
    add(std::to_string(link.from.value) + " \u2192 " + std::to_string(link.to.value), link, most);
  }
  if (links.size() > shown) {
    const LinkTraffic others = sum_of(links, shown);
    add(std::to_string(links.size() - shown) + " others", others, busiest_part(others));
  }
  const LinkTraffic all = sum_of(links, 0);
  add("all", all, busiest_part(all));
  const Box drawn{table.x, table.y, table.width, row.y - table.y};
  svg.rectangle(drawn, {.stroke = kFaint});
  for (std::size_t i = 1; i < paths.size(); ++i) {
    if (!paths[i].empty()) svg.path(paths[i], {.fill = kScale[i]});
  }
  draw_time_axis(svg, drawn, 0, run.end_s);
}

}  // namespace

std::string ending_text(const RunRecord& run) {
  if (!run.outcome.failed) return "";
  return run.outcome.failed->code == FailureCode::kDeadlock ? "; it ended in a deadlock"
                                                            : "; it failed";
}

std::string traffic_svg(std::string_view scene, const Picture& picture,
                        const RenderSettings& settings, const Hypercube& cube,
                        const RunRecord& run) {
  const auto links = traffic_of(run, kParts);
  const auto received = received_by(links, cube.nodes());
  const std::uint64_t rays = std::accumulate(received.begin(), received.end(), std::uint64_t{0});
  Svg svg = begin_page(
      kWidth, kHeight,
      std::string(scene) + ": rays from node to node, " + std::to_string(cube.nodes()) + " nodes",
      count_text(rays) + " rays in " + count_text(run.shipments.size()) + " messages across " +
          std::to_string(links.size()) + " directed links" + ending_text(run) +
          " (report, figure 9)");
  const ShownPicture shown(picture, kMap);
  shown.draw(svg, 0.6);
  const auto places = node_places(shown, picture, cube, run.grid);
  draw_boundaries(svg, shown, picture, run.grid);
  draw_ways(svg, cube, places, links);
  draw_nodes(svg, places, received);
  const bool has_hidden = draw_lights(svg, shown, settings);
  draw_table(svg, run, links);
  draw_legend(
      svg, {kMargin, kHeight - 74}, kWidth - 2 * kMargin,
      {{LegendEntry::Sign::kArrow, kRed, "rays to a neighbour: the wider, the more"},
       {LegendEntry::Sign::kArrow, kViolet, "across a link round the back or to no neighbour"},
       {LegendEntry::Sign::kDot, kScale[5], "node: the darker, the more rays it received"},
       {LegendEntry::Sign::kDot, kGold, has_hidden ? "light (others are behind the eye)" : "light"},
       {LegendEntry::Sign::kArea, kScale[4],
        "rays sent in a part of the time (sums by themselves)"}});
  return svg.finish();
}

}  // namespace graycube::figures
