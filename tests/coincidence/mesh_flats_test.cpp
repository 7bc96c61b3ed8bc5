#include "coincidence/mesh_flats.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "catch.hpp"
#include "csg/dice.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;
using graycube::csg::Flat;
using graycube::csg::MeshFlats;

namespace {

MeshFlats flats_of(const TriangleMesh& mesh, double distance) {
  std::vector<std::uint32_t> all(mesh.triangles.size());
  for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
  return MeshFlats(mesh, std::move(all), distance);
}

/// The numbers of triangles of all flat parts, the largest first; each triangle must belong to one
/// part.
std::vector<std::uint32_t> sizes(const TriangleMesh& mesh, const MeshFlats& flats) {
  std::vector<std::uint32_t> counts, found;
  for (const Flat& f : flats.flats()) {
    counts.push_back(f.count);
    for (const std::uint32_t t : flats.triangles_of(f)) found.push_back(t);
  }
  std::sort(found.begin(), found.end());
  REQUIRE(found.size() == mesh.triangles.size());
  for (std::uint32_t i = 0; i < found.size(); ++i) REQUIRE(found[i] == i);
  std::sort(counts.rbegin(), counts.rend());
  return counts;
}

void shake(TriangleMesh& mesh, double distance, Dice& dice) {
  for (Vec3& p : mesh.points) p = p + dice.point(distance);
}

}  // namespace

TEST_CASE("an end of slender triangles is one flat part, and known as well as it is wide") {
  constexpr std::uint32_t kSides = 96;
  constexpr double kDistance = 1e-4, kRadius = 3;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    TriangleMesh mesh = closed(drum_polygons(kRadius, 0, 6, kSides));
    shake(mesh, kDistance, dice);
    const MeshFlats flats = flats_of(mesh, kDistance);
    const auto counts = sizes(mesh, flats);
    REQUIRE(counts.size() >= 2);
    CHECK(counts[0] == kSides - 2);
    CHECK(counts[1] == kSides - 2);
    for (const Flat& f : flats.flats()) {
      if (f.count != kSides - 2) continue;
      CHECK(f.width > kRadius);
      CHECK(std::fabs(f.plane.normal.z) > 1 - 1e-7);
      CHECK(dot(f.plane.normal, f.middle) == Approx(f.plane.offset));
    }
  }
}

TEST_CASE("the faces of a box are six flat parts, however thin it is") {
  for (const double height : {1.0, 1e-3, 1e-5}) {
    const TriangleMesh mesh = closed(box_polygons({0, 0, 0}, {2, 3, height}));
    CHECK(sizes(mesh, flats_of(mesh, 1e-7)) == std::vector<std::uint32_t>(6, 2));
  }
}

TEST_CASE("facets of a ring that lie in different planes are told apart") {
  const TriangleMesh mesh = closed(ring_polygons(3, 1, 24, 16));
  // Each quad lies in one plane.
  CHECK(sizes(mesh, flats_of(mesh, 1e-12)) == std::vector<std::uint32_t>(24 * 16, 2));
}

TEST_CASE("triangles without an area are in flat parts, too") {
  TriangleMesh mesh = closed(box_polygons({0, 0, 0}, {1, 1, 1}));
  for (Vec3& p : mesh.points) p.x = 0;
  const MeshFlats flats = flats_of(mesh, 0);
  CHECK(std::accumulate(flats.flats().begin(), flats.flats().end(), 0u,
                        [](std::uint32_t n, const Flat& f) { return n + f.count; }) == 12);
  CHECK(flats_of(TriangleMesh{}, 1).flats().empty());
}
