// Makes points one that are close to each other.
#include "mesh/join_points.hpp"

#include <numeric>
#include <random>

#include "catch.hpp"
#include "mesh/edges.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Every face with points of its own, each coordinate off by up to `noise`.
PolygonMesh shaken(const PolygonMesh& mesh, double noise, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-noise, noise);
  PolygonMesh out;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : mesh.face_ends) {
    std::vector<std::uint32_t> face;
    for (std::uint32_t i = begin; i < end; ++i) {
      face.push_back(static_cast<std::uint32_t>(out.points.size()));
      out.points.push_back(mesh.points[mesh.corners[i]] +
                           Vec3{off(random), off(random), off(random)});
    }
    out.add_face(face);
    begin = end;
  }
  return out;
}

}  // namespace

TEST_CASE("joined points are near the point they become, and those that stay are far apart") {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-1, 1);
    constexpr double kDistance = 0.1;
    std::vector<Vec3> points(400);
    for (Vec3& p : points) p = {place(random), place(random), place(random)};
    std::vector<std::uint32_t> chosen(300);
    std::iota(chosen.begin(), chosen.end(), 50u);
    const auto number = joined_points(points, chosen, kDistance);
    std::size_t joined = 0;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
      if (i < 50 || i >= 350) CHECK(number[i] == i);
      CHECK(number[number[i]] == number[i]);
      CHECK(max_abs(points[i] - points[number[i]]) <= kDistance);
      if (number[i] != i) ++joined;
    }
    CHECK(joined > 0);
    for (std::uint32_t i = 50; i < 350; ++i) {
      for (std::uint32_t j = 50; j < i; ++j) {
        if (number[i] != i || number[j] != j) continue;
        CHECK(max_abs(points[i] - points[j]) > kDistance);
      }
    }
  }
}

TEST_CASE("corners that differ by rounding are one where the mesh is open otherwise") {
  for (const double scale : {1e-30, 1.0, 1e30}) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      INFO("scale " << scale << ", seed " << seed);
      PolygonMesh ring = shaken(ring_polygons(3, 1, 9, 7), 2e-14, seed);
      for (Vec3& p : ring.points) p = scale * p;
      CHECK(closed(ring).points.size() == 63);
      CHECK(closed(ring).triangles.size() == 126);
    }
  }
}

TEST_CASE("corners that differ by more than rounding stay apart") {
  CHECK(fault_of(shaken(box_polygons({0, 0, 0}, {1, 1, 1}), 1e-9, 1)).find("not closed") == 0);
}

TEST_CASE("a closed mesh keeps corners that lie within rounding of each other") {
  const PolygonMesh thin = box_polygons({0, 0, 100}, {10, 10, 100 + 5e-14});
  REQUIRE(thin.points[7].z != thin.points[0].z);
  CHECK(closed(thin).points.size() == 8);
}
