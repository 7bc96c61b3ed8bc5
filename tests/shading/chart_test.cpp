// u and v on solids, and the patterns that follow them.
#include "shading/chart.hpp"

#include <cmath>

#include "catch.hpp"
#include "csg/dice.hpp"
#include "shading/pattern.hpp"

using namespace graycube;
using graycube::testing::Dice;

namespace {

constexpr double kTurn = 2 * 3.14159265358979323846;

Chart chart(ChartKind kind, const Affine& to_solid = {}) {
  Chart c;
  c.kind = kind;
  c.maps = {to_solid};
  return c;
}
bool is_near(const Vec3& a, const Vec3& b) { return length(a - b) < 1e-9; }

/// The angle of (x, y) as a part of a turn, 0 … 1.
double part_of_turn(double y, double x) {
  const double part = std::atan2(y, x) / kTurn;
  return part < 0 ? part + 1 : part;
}

}  // namespace

TEST_CASE("on a sphere u is the longitude and v goes from pole to pole") {
  const Chart c =
      chart(ChartKind::kSphere, compose(scaling({0.5, 0.5, 0.5}), translation({-3, 0, 0})));
  Dice dice(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = normalized(dice.point(1));
    const Vec3 uv{part_of_turn(p.y, p.x), std::asin(p.z) / (kTurn / 2) + 0.5, 0};
    CHECK(is_near(chart_point(c, Vec3{3, 0, 0} + 2 * p), uv));
  }
  CHECK(chart_point(c, {3, 0, 2}) == Vec3{0, 1, 0});
  CHECK(chart_point(c, {3, 0, 0}) == Vec3{0, 0.5, 0});
}

TEST_CASE("on a torus v goes about the ring from its inside by way of its underside") {
  const Chart c = chart(ChartKind::kTorus);
  CHECK(is_near(chart_point(c, {1, 0, -0.25}), {0, 0.25, 0}));
  CHECK(is_near(chart_point(c, {0, 1.25, 0}), {0.25, 0.5, 0}));
  CHECK(is_near(chart_point(c, {-1, 0, 0.25}), {0.5, 0.75, 0}));
  CHECK(is_near(chart_point(c, {0.75, 0, 0}), {0, 0, 0}));
}

TEST_CASE("on a round solid v is the height, and on its ends what they say") {
  Chart c = chart(ChartKind::kRound);
  c.ends = {EndChart::kZeroAtRim, EndChart::kOneAtRim};
  c.top_radii = {0.5, 2};
  CHECK(is_near(chart_point(c, {0, 1.5, 0.5}), {0.25, 0.5, 0}));
  CHECK(is_near(chart_point(c, {0.25, 0, 0}), {0, 0.75, 0}));
  CHECK(is_near(chart_point(c, {0.25, 0, 1}), {0, 0.5, 0}));
  CHECK(is_near(chart_point(c, {0, -1, 1}), {0.75, 0.5, 0}));
  // At 45° of its own ellipse everywhere: the lines of equal longitude are straight.
  for (const double z : {0.0, 0.3, 1.0}) {
    const Vec3 rim{(1 - z) + 0.5 * z, (1 - z) + 2 * z, z};
    CHECK(chart_point(c, {std::sqrt(0.5) * rim.x, std::sqrt(0.5) * rim.y, z}).x == Approx(0.125));
  }
  c.ends = {EndChart::kOneAtRim, EndChart::kNone};
  CHECK(is_near(chart_point(c, {0.25, 0, 0}), {0, 0.25, 0}));
  CHECK(is_near(chart_point(c, {0.25, 0, 1}), {0, 1, 0}));
  // The tip of a cone.
  c.top_radii = {0, 0};
  CHECK(chart_point(c, {0, 0, 1}).y == 1);
}

TEST_CASE("on a trough u goes about it and v along it, on its ends from the middle to the rim") {
  const Chart c = chart(ChartKind::kTrough);
  CHECK(is_near(chart_point(c, {0.25, 0, 0.9}), {0.5, 0.25, 0}));
  CHECK(is_near(chart_point(c, {0.25, std::sqrt(0.5), std::sqrt(0.5)}), {0.25, 0.25, 0}));
  CHECK(is_near(chart_point(c, {0.25, -0.5, 0}), {0.75, 0.25, 0}));
  CHECK(is_near(chart_point(c, {0, 0, 0.5}), {0.5, 0.5, 0}));
  CHECK(is_near(chart_point(c, {1, 0, 0.25}), {0.5, 0.25, 0}));
}

TEST_CASE("on a plane u and v go to and fro") {
  const Chart c = chart(ChartKind::kPlane);
  CHECK(is_near(chart_point(c, {0.25, 0.75, 9}), {0.25, 0.75, 0}));
  CHECK(is_near(chart_point(c, {1.25, -0.25, 0}), {0.75, 0.25, 0}));
  CHECK(is_near(chart_point(c, {-2.25, 7, 0}), {0.25, 1, 0}));
}

TEST_CASE("of several faces the nearest counts") {
  Chart c = chart(ChartKind::kFaces);
  // The face x = 1: u is y, v is z.
  Affine side;
  side.m = {{{0, 1, 0, 0}, {0, 0, 1, 0}, {1, 0, 0, -1}}};
  c.maps.push_back(side);
  CHECK(is_near(chart_point(c, {0.25, 0.5, 1e-12}), {0.25, 0.5, 0}));
  CHECK(is_near(chart_point(c, {1, 0.5, 0.75}), {0.5, 0.75, 0}));
}

TEST_CASE("u and v are 0 to 1 whatever the point is") {
  constexpr double kBig = 1e300;
  for (std::uint8_t kind = 1; kind < kChartKinds; ++kind) {
    for (const Vec3& p : {Vec3{kBig, -kBig, kBig}, Vec3{}, Vec3{0, 0, 1}, Vec3{0, 0, -1e-300},
                          Vec3{std::nan(""), 1, 2}, Vec3{1, 0, kBig}, Vec3{-5, -5, -5}}) {
      Chart c = chart(static_cast<ChartKind>(kind));
      c.ends = {EndChart::kOneAtRim, EndChart::kZeroAtRim};
      c.top_radii = {0, 2};
      const Vec3 at = chart_point(c, p);
      INFO(int{kind} << ": " << p.x << " " << p.y << " " << p.z);
      CHECK((at.x >= 0 && at.x <= 1 && at.y >= 0 && at.y <= 1));
    }
  }
}

TEST_CASE("a pattern with a chart has its place by u and v") {
  Pattern squares;
  squares.kind = PatternKind::kChecker;
  squares.colors = {{{1, 0, 0}, {0, 0, 1}, {0, 0, 0}}};
  squares.to_pattern = scaling({2, 2, 1});
  squares.chart = chart(ChartKind::kSphere);
  // Eighths of the ball: front and back, above and below.
  CHECK(color_at(squares, {}, normalized(Vec3{1, 1, -1})) == squares.colors[0]);
  CHECK(color_at(squares, {}, normalized(Vec3{-1, 1, -1})) == squares.colors[0]);
  CHECK(color_at(squares, {}, normalized(Vec3{1, -1, -1})) == squares.colors[1]);
  CHECK(color_at(squares, {}, normalized(Vec3{1, 1, 1})) == squares.colors[1]);
  Pattern ramp = squares;
  ramp.kind = PatternKind::kGradient;
  ramp.to_pattern = {};
  CHECK(color_at(ramp, {}, {0, 1, 0}) == Rgb{0.25, 0, 0.5});
}

TEST_CASE("clouds have the brightness of liboptical's, and hide the sky by it") {
  // By sh_cloud.c's cloud_texture, with contrast 1 and frequencies 2 and 1, at (0.1, 0.2).
  const double k = 0.707;
  const double x = 0.1, y = 0.2;
  double px = kTurn / 4 * std::sin(0.5 * kTurn * y), py = kTurn / 4 * std::sin(0.5 * 2 * kTurn * x);
  double fx = 2 * kTurn, fy = kTurn, c = 1, t1 = 0, t2 = 0;
  for (int i = 0; i < 4; ++i, c *= k) {
    t1 += c * std::sin(fx * x + px) + 1;
    t2 += c * std::sin(fy * y + py) + 1;
    px = kTurn / 4 * std::sin(fy * y);
    py = kTurn / 4 * std::sin(fx * x);
    fx *= 2;
    fy *= 2;
  }
  const double cloud = t1 * t2 / 32;
  REQUIRE((cloud > 0.4 && cloud < 1));
  Pattern m;
  m.kind = PatternKind::kClouds;
  m.colors[0] = {0.25, 0.5, 0.75};
  m.thresholds = {0.35, 1};
  const double sky = 1 - (cloud - 0.35);
  CHECK(color_at(m, {}, {x, y, 0}).b == Approx((1 - sky) * cloud + sky * 0.75));
  m.thresholds = {cloud - 0.01, 0.005};
  CHECK(color_at(m, {}, {x, y, 0}).g == Approx(cloud));
  m.thresholds = {cloud + 0.01, 0.005};
  CHECK(color_at(m, {}, {x, y, 0}) == m.colors[0]);
}
