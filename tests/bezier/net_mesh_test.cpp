// Nets of Bézier patches as meshes: closed, as near to the patches as asked for, and with faults
// that name the side that is open.
#include "bezier/net_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>

#include "bezier/division.hpp"
#include "catch.hpp"
#include "samples.hpp"

using namespace graycube;
using graycube::testing::ball_net;
using graycube::testing::cube_net;

namespace {

TriangleMesh meshed(const BezierNet& net, double tolerance) {
  auto made = mesh_of(net, tolerance);
  if (const auto* fault = std::get_if<MeshFault>(&made)) FAIL(fault->why);
  return std::get<TriangleMesh>(std::move(made));
}
std::string fault_of(const BezierNet& net, double tolerance = 0.01) {
  const auto made = mesh_of(net, tolerance);
  const auto* fault = std::get_if<MeshFault>(&made);
  return fault == nullptr ? "" : fault->why;
}

/// A patch's point by Bernstein's polynomials.
Vec3 surface(const BezierNet& net, const BezierPatch& patch, double u, double v) {
  const auto weights = [](double t) {
    const double s = 1 - t;
    return std::array<double, 4>{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  };
  const auto across = weights(u), up = weights(v);
  Vec3 sum;
  for (std::size_t i = 0; i < 16; ++i)
    sum = sum + (across[i % 4] * up[i / 4]) * net.points[patch[i]];
  return sum;
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 d = b - a;
  const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
  return length(p - a - t * d);
}
double distance_to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(b - a, c - a);
  const auto is_left = [&](const Vec3& from, const Vec3& to) {
    return dot(cross(to - from, p - from), n) >= 0;
  };
  if (is_left(a, b) && is_left(b, c) && is_left(c, a)) return std::fabs(dot(p - a, n)) / length(n);
  return std::min(distance_to_segment(p, a, b),
                  std::min(distance_to_segment(p, b, c), distance_to_segment(p, c, a)));
}
double distance_to_mesh(const Vec3& p, const TriangleMesh& mesh) {
  double least = INFINITY;
  for (const auto& [a, b, c] : mesh.triangles) {
    least =
        std::min(least, distance_to_triangle(p, mesh.points[a], mesh.points[b], mesh.points[c]));
  }
  return least;
}

/// Whether each edge is used as often one way as the other.
bool is_closed(const TriangleMesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      edges[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  }
  return std::all_of(edges.begin(), edges.end(), [](const auto& e) { return e.second == 0; });
}

/// A net whose patches are cut unevenly: one point sticks out.
BezierNet uneven_net() {
  BezierNet net = cube_net(0.1, 5);
  const std::uint32_t within = net.patches[3][5];
  net.points[within] = 4 * net.points[within];
  return net;
}

}  // namespace

TEST_CASE("flat patches whose points are evenly spread become two triangles each") {
  const TriangleMesh mesh = meshed(cube_net(), 1e-9);
  CHECK(mesh.points.size() == 8);
  CHECK(mesh.triangles.size() == 12);
  CHECK(enclosed_volume(mesh) == 8);
}

TEST_CASE("patches of different fineness share the corners of their seams") {
  const BezierNet net = uneven_net();
  const auto division = std::get<BezierDivision>(division_of(net, 0.003));
  CHECK(division.patches[3].u > division.patches[2].u);
  const TriangleMesh mesh = meshed(net, 0.003);
  CHECK(is_closed(mesh));
  CHECK(mesh.triangles.size() <= division.triangles);
  CHECK(10 * mesh.triangles.size() > 9 * division.triangles);
}

TEST_CASE("patches and triangles are within the tolerance of one another") {
  const double tolerance = GENERATE(0.1, 0.02, 0.005);
  const BezierNet net = uneven_net();
  const TriangleMesh mesh = meshed(net, tolerance);
  std::mt19937_64 random(11);
  const auto fraction = [&] { return std::generate_canonical<double, 53>(random); };
  double worst = 0;
  for (const BezierPatch& patch : net.patches) {
    for (int i = 0; i < 100; ++i) {
      const double u = fraction(), v = fraction();
      worst = std::max(worst, distance_to_mesh(surface(net, patch, u, v), mesh));
    }
  }
  CHECK(worst <= tolerance);
  // The bound is no more careful than it need be.
  CHECK(worst > tolerance / 40);
}

TEST_CASE("random nets are closed at any tolerance, with their volume outward") {
  const auto seed = GENERATE(range(1, 30));
  INFO("seed " << seed);
  const BezierNet net = cube_net(0.25, static_cast<std::uint64_t>(seed));
  for (const double tolerance : {0.3, 0.03, 0.003}) {
    const TriangleMesh mesh = meshed(net, tolerance);
    REQUIRE(is_closed(mesh));
    CHECK(enclosed_volume(mesh) > 4);
  }
}

TEST_CASE("a side may be a pole, and points written twice are one") {
  const TriangleMesh coarse = meshed(ball_net(), 0.01), fine = meshed(ball_net(), 1e-5);
  CHECK(is_closed(coarse));
  CHECK(is_closed(fine));
  const double ball = 4.0 / 3 * 3.14159265358979323846;
  CHECK(std::fabs(enclosed_volume(fine) / ball - 1) < 1e-3);
  CHECK(enclosed_volume(coarse) < enclosed_volume(fine));
  for (const Vec3& p : fine.points) REQUIRE(std::fabs(length(p) - 1) < 6e-4);
}

TEST_CASE("patches that are turned over are turned back") {
  BezierNet net = cube_net(0.2, 3);
  const double volume = enclosed_volume(meshed(net, 0.01));
  for (const std::size_t p : {std::size_t{1}, std::size_t{4}}) {
    BezierPatch& patch = net.patches[p];
    for (std::size_t row = 0; row < 4; ++row)
      std::reverse(patch.begin() + 4 * static_cast<std::ptrdiff_t>(row),
                   patch.begin() + 4 * static_cast<std::ptrdiff_t>(row + 1));
  }
  const TriangleMesh mesh = meshed(net, 0.01);
  CHECK(is_closed(mesh));
  CHECK(enclosed_volume(mesh) == Approx(volume).epsilon(1e-3));
}

TEST_CASE("an open side is told with its patch and its ends") {
  BezierNet net = cube_net();
  net.patches.pop_back();
  CHECK(fault_of(net) ==
        "the patches are not closed: the side of patch 0 from point 3 to point 15 meets no other "
        "side of the same four points; 3 more are open");
  net = cube_net();
  const Vec3 moved = net.points[net.patches[0][1]] + Vec3{0, 0, 1e-9};
  net.patches[0][1] = static_cast<std::uint32_t>(net.points.size());
  net.points.push_back(moved);
  CHECK(fault_of(net).find("meets no other side of the same four points; 1 more is open") !=
        std::string::npos);
  net = cube_net();
  net.patches.push_back(net.patches[2]);
  CHECK(fault_of(net).find("meets 2 others, which can't be paired; 3 more are open") !=
        std::string::npos);
}

TEST_CASE("a tolerance that takes too many triangles is refused before they are made") {
  CHECK(fault_of(cube_net(0.2), 1e-7) == "a tolerance so fine takes more than 8388608 triangles");
  CHECK(fault_of(cube_net(0.2), 1e-300) == "a tolerance so fine takes more than 8388608 triangles");
  BezierNet far = cube_net();
  for (Vec3& p : far.points) p = 1e308 * p;
  CHECK(fault_of(far, 1e300) == "a tolerance so fine takes more than 8388608 triangles");
}

TEST_CASE("patches of nothing but one point are no solid") {
  BezierNet net = cube_net();
  for (Vec3& p : net.points) p = {1, 2, 3};
  CHECK_FALSE(fault_of(net).empty());
}
