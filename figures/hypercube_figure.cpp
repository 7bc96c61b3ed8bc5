#include "figures/hypercube_figure.hpp"

#include <algorithm>
#include <array>

#include "figures/page/page.hpp"

namespace graycube::figures {
namespace {

constexpr double kWidth = 1040, kHeight = 560;

/// How far a step along each bit of a label moves on the page, in units of the shortest: a square;
/// a second one behind it, which makes a cube; more cubes beside and above. No step passes a node.
constexpr std::array<Point, 6> kSteps{
    {{1, 0}, {0, -1}, {0.42, -0.34}, {2.2, 0.55}, {0.62, -2.35}, {4.9, 0.25}}};
static_assert(kMostNodesDrawn == 1u << kSteps.size());

constexpr std::string_view color_of(CubeEdge::Use use) {
  return use == CubeEdge::Use::kColumns ? kBlue : use == CubeEdge::Use::kRows ? kOrange : kFaint;
}

/// A node's place in units of kSteps.
Point place_of(GrayLabel label) {
  Point p;
  for (std::uint32_t bit = 0; bit < kSteps.size(); ++bit) {
    if ((label.value >> bit & 1) == 0) continue;
    p.x += kSteps[bit].x;
    p.y += kSteps[bit].y;
  }
  return p;
}

std::vector<Point> places_in(const Hypercube& cube, const Box& box) {
  std::vector<Point> places;
  Point lo, hi;
  for (std::uint32_t r = 0; r < cube.nodes(); ++r) {
    const Point p = places.emplace_back(place_of(cube.label_of(Rank{r})));
    lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
    hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
  }
  const double scale = std::min(
      {box.width / std::max(hi.x - lo.x, 1e-9), box.height / std::max(hi.y - lo.y, 1e-9), 170.0});
  const Point middle{(lo.x + hi.x) / 2, (lo.y + hi.y) / 2};
  for (Point& p : places) {
    p = {box.center().x + (p.x - middle.x) * scale, box.center().y + (p.y - middle.y) * scale};
  }
  return places;
}

void draw_node(Svg& svg, const Hypercube& cube, Rank rank, Point at, double radius) {
  svg.circle(at, radius, {.fill = kWhite, .stroke = kInk, .width = 1.2});
  svg.text({at.x, at.y + 4}, std::to_string(rank.value),
           {.size = radius > 11 ? 12.0 : 10.0, .anchor = Anchor::kMiddle, .is_bold = true});
  svg.text({at.x + 0.75 * radius + 2, at.y + radius + 6}, bits_text(cube, cube.label_of(rank)),
           {.size = radius > 11 ? 11.0 : 8.5, .color = kQuiet, .has_rim = true});
}

double radius_for(const Hypercube& cube) { return cube.nodes() > 16 ? 9 : 14; }

void draw_cube(Svg& svg, const Hypercube& cube, const Box& box) {
  const std::vector<Point> places = places_in(cube, box);
  for (const bool is_used : {false, true}) {
    for (const CubeEdge& e : edges_of(cube)) {
      if ((e.use != CubeEdge::Use::kUnused) != is_used) continue;
      svg.line(places[e.a.value], places[e.b.value],
               {.stroke = color_of(e.use), .width = is_used ? 2.2 : 1.2});
    }
  }
  for (std::uint32_t r = 0; r < cube.nodes(); ++r) {
    draw_node(svg, cube, Rank{r}, places[r], radius_for(cube));
  }
}

/// The same nodes in columns and rows; links round the ends leave at the sides.
void draw_grid(Svg& svg, const Hypercube& cube, const Box& box) {
  const double side = std::min({box.width / cube.columns(), box.height / cube.rows(), 96.0});
  const Point first{box.center().x - side * (cube.columns() - 1) / 2,
                    box.center().y - side * (cube.rows() - 1) / 2};
  const auto place = [&](Rank r) {
    return Point{first.x + side * cube.column_of(r), first.y + side * cube.row_of(r)};
  };
  const double stub = side * 0.42;
  for (const CubeEdge& e : edges_of(cube)) {
    if (e.use == CubeEdge::Use::kUnused) continue;
    const bool is_row = e.use == CubeEdge::Use::kColumns;
    Point a = place(e.a), b = place(e.b);
    if (is_row ? a.x > b.x : a.y > b.y) std::swap(a, b);
    const Paint paint{.stroke = color_of(e.use), .width = 2.2};
    if ((is_row ? b.x - a.x : b.y - a.y) < 1.5 * side) {
      svg.line(a, b, paint);
      continue;
    }
    const Paint round{.stroke = paint.stroke, .width = 2.2, .dashes = "4 3"};
    svg.line(a, is_row ? Point{a.x - stub, a.y} : Point{a.x, a.y - stub}, round);
    svg.line(b, is_row ? Point{b.x + stub, b.y} : Point{b.x, b.y + stub}, round);
  }
  for (std::uint32_t r = 0; r < cube.nodes(); ++r) {
    draw_node(svg, cube, Rank{r}, place(Rank{r}), radius_for(cube));
  }
}

}  // namespace

std::vector<CubeEdge> edges_of(const Hypercube& cube) {
  std::vector<CubeEdge> edges;
  const auto are_next = [](std::uint32_t a, std::uint32_t b, std::uint32_t count) {
    return (a + 1) % count == b || (b + 1) % count == a;
  };
  for (std::uint32_t r = 0; r < cube.nodes(); ++r) {
    for (std::uint32_t bit = 0; bit < cube.dimension(); ++bit) {
      const Rank a{r}, b = cube.neighbour(a, bit);
      if (b < a) continue;
      const bool has_same_row = cube.row_of(a) == cube.row_of(b);
      const bool is_grid = has_same_row
                               ? are_next(cube.column_of(a), cube.column_of(b), cube.columns())
                               : are_next(cube.row_of(a), cube.row_of(b), cube.rows());
      edges.push_back({a, b,
                       !is_grid       ? CubeEdge::Use::kUnused
                       : has_same_row ? CubeEdge::Use::kColumns
                                      : CubeEdge::Use::kRows});
    }
  }
  return edges;
}

std::string bits_text(const Hypercube& cube, GrayLabel label) {
  std::string bits;
  for (std::uint32_t bit = cube.dimension(); bit-- > 0;) {
    bits += (label.value >> bit & 1) != 0 ? '1' : '0';
  }
  return bits.empty() ? "0" : bits;
}

std::string hypercube_svg(const Hypercube& cube) {
  const auto edges = edges_of(cube);
  const auto used = std::count_if(edges.begin(), edges.end(), [](const CubeEdge& e) {
    return e.use != CubeEdge::Use::kUnused;
  });
  Svg svg = begin_page(
      kWidth, kHeight,
      "A hypercube of " + std::to_string(cube.nodes()) + (cube.nodes() == 1 ? " node" : " nodes") +
          ", and its grid",
      "Dimension " + std::to_string(cube.dimension()) + ", " + std::to_string(edges.size()) +
          " links, " + std::to_string(used) + " of them between neighbours of a grid of " +
          std::to_string(cube.columns()) + " \u00D7 " + std::to_string(cube.rows()) +
          " macro-regions (report, figures 6 and 7)");
  draw_cube(svg, cube, {kMargin + 30, kHead + 30, 520, 380});
  draw_grid(svg, cube, {620, kHead + 20, 380, 400});
  draw_legend(svg, {kMargin, kHeight - 36}, kWidth - 2 * kMargin,
              {{LegendEntry::Sign::kLine, kBlue, "link to the next column"},
               {LegendEntry::Sign::kLine, kOrange, "link to the next row"},
               {LegendEntry::Sign::kDashes, kQuiet, "round the back of the eye"},
               {LegendEntry::Sign::kLine, kFaint, "link that the grid doesn't need"},
               {LegendEntry::Sign::kDot, kWhite, "node: rank, and Gray label below"}});
  return svg.finish();
}

}  // namespace graycube::figures
