// Meshes as solids.
#include "mesh/mesh.hpp"

#include "catch.hpp"
#include "csg/dice.hpp"
#include "csg/one_primitive.hpp"
#include "mesh/line.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// The sum of all triangles' counts along the line, in the mesh's order.
int sum_of_counts(const TriangleMesh& mesh, const Ray& ray) {
  const csg::MeshLine line(ray);
  int sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const int count = csg::triangle_count(line, mesh.points[a], mesh.points[b], mesh.points[c]);
    REQUIRE(std::abs(count) <= 1);
    sum += count;
  }
  return sum;
}

/// A ray exactly through a corner, along an edge, within a face, or at anything.
Ray awkward_ray(const TriangleMesh& mesh, Dice& dice) {
  const Triangle& t = mesh.triangles[dice.below(mesh.triangles.size())];
  const Vec3 &a = mesh.points[t[0]], &b = mesh.points[t[1]], &c = mesh.points[t[2]];
  switch (dice.below(6)) {
    case 0: return {a, dice.axis()};
    case 1: return {a, normalized(b - a)};
    case 2: return {a + 2.0 * (a - b), normalized(b - a)};
    case 3: return {a, normalized(0.5 * (b + c) - a)};
    case 4: {
      const Vec3 from = dice.grid_point(4);
      return {from, from == a ? dice.axis() : normalized(a - from)};
    }
    default: return {dice.grid_point(3), dice.axis()};
  }
}

std::vector<TriangleMesh> meshes() {
  PolygonMesh hollow = box_polygons({-2, -2, -2}, {2, 2, 2});
  append(hollow, box_polygons({-1, -1, -1}, {1, 1, 1}), true);
  PolygonMesh overlapping = box_polygons({-1, -1, -1}, {1, 1, 1});
  append(overlapping, box_polygons({0, 0, 0}, {2, 2, 2}));
  append(overlapping, ring_polygons(1, 0.5, 6, 6));
  return {closed(box_polygons({-1, -1, -1}, {1, 1, 1})), closed(hollow), closed(overlapping),
          closed(ring_polygons(2, 1, 8, 8)), closed(ball_polygons(2, 9, 12))};
}

}  // namespace

TEST_CASE(
    "every line leaves a closed mesh as often as it enters, through corners and along edges too") {
  Dice dice(11);
  for (const TriangleMesh& mesh : meshes()) {
    for (int i = 0; i < 3000; ++i) {
      const Ray ray = awkward_ray(mesh, dice);
      INFO("ray " << i);
      REQUIRE(sum_of_counts(mesh, ray) == 0);
    }
  }
}

TEST_CASE("an edge counts one way what it counts the other way, negated") {
  Dice dice(12);
  for (int i = 0; i < 20000; ++i) {
    // Magnitudes at which products vanish or overflow, and many exact zeros.
    const double scale = std::ldexp(1.0, static_cast<int>(dice.below(1200)) - 600);
    const auto number = [&] {
      return dice.one_in(3) ? dice.on_grid(2) : scale * dice.between(-1, 1);
    };
    const csg::LinePoint a{number(), number()}, b{number(), number()};
    REQUIRE(csg::edge_count(a, b) == -csg::edge_count(b, a));
  }
}

TEST_CASE("the side of an edge is found where rounded products tie") {
  const double x = 1 + 0x1p-30, y = 1 + 0x1p-31;
  // x · x and (1 + 2⁻²⁹) · 1 differ by 2⁻⁶⁰.
  CHECK(csg::side_of_origin({x, 1 + 0x1p-29}, {1, x}) == 1);
  CHECK(csg::side_of_origin({1, x}, {x, 1 + 0x1p-29}) == -1);
  CHECK(csg::side_of_origin({y, y}, {y, y}) == 0);
}

TEST_CASE("a ray meets each box face once wherever it goes through it") {
  const Mesh box(closed(box_polygons({0, 0, 0}, {2, 2, 2})));
  for (int i = 0; i <= 4; ++i) {
    for (int j = 0; j <= 4; ++j) {
      const double y = 0.5 * i, z = 0.5 * j;
      const Spans spans = box.spans({{-3, y, z}, {1, 0, 0}});
      // On the border either answer will do, in between there is one.
      if (i > 0 && i < 4 && j > 0 && j < 4) REQUIRE(spans.count == 1);
      REQUIRE(spans.count <= 1);
      if (spans.count == 0) continue;
      CHECK(spans.interval[0].enter == 3);
      CHECK(spans.interval[0].leave == 5);
    }
  }
}

TEST_CASE("a mesh of a box has the box's spans, bit for bit, and its normals") {
  Dice dice(13);
  for (int i = 0; i < 200; ++i) {
    const Vec3 lo = dice.one_in(2) ? dice.grid_point(2) : dice.point(2);
    const Vec3 hi = lo + Vec3{dice.between(0.5, 2), dice.between(0.5, 2), dice.between(0.5, 2)};
    const OnePrimitive box(node_of(BoxShape{lo, hi}));
    const OnePrimitive mesh(node_of(MeshShape{closed(box_polygons(lo, hi))}));
    for (int r = 0; r < 20; ++r) {
      const Ray ray{dice.point(6), normalized(dice.point(2))};
      const Spans a = box.spans(ray), b = mesh.spans(ray);
      // Rays that graze an edge may cross a sliver in one case only.
      if (a.count == 1 && a.interval[0].leave - a.interval[0].enter < 1e-9) continue;
      REQUIRE(a.count == b.count);
      if (a.count == 0) continue;
      REQUIRE(a.interval[0].enter == b.interval[0].enter);
      REQUIRE(a.interval[0].leave == b.interval[0].leave);
      REQUIRE(length(box.normal(ray, a.interval[0].enter) - mesh.normal(ray, a.interval[0].enter)) <
              1e-12);
      REQUIRE(length(box.normal(ray, a.interval[0].leave) - mesh.normal(ray, a.interval[0].leave)) <
              1e-12);
    }
  }
}

TEST_CASE("a convex mesh is hit where the polyhedron of its planes is, under any map") {
  Dice dice(14);
  for (int i = 0; i < 60; ++i) {
    const auto rings = static_cast<std::uint32_t>(1 + dice.below(5)),
               columns = static_cast<std::uint32_t>(3 + dice.below(6));
    const TriangleMesh ball = closed(ball_polygons(dice.between(0.5, 2), rings, columns));
    PolyhedronShape planes;
    for (const auto& [a, b, c] : ball.triangles) {
      const Vec3 n =
          normalized(cross(ball.points[b] - ball.points[a], ball.points[c] - ball.points[a]));
      planes.planes.push_back({n, dot(n, ball.points[a])});
    }
    RandomModel random(static_cast<std::uint64_t>(i));
    const Affine map = random.map();
    const OnePrimitive solid(transformed(node_of(planes), map));
    const OnePrimitive mesh(transformed(node_of(MeshShape{ball}), map));
    for (int r = 0; r < 50; ++r) {
      const Ray ray = ray_towards(mesh, dice);
      const Spans a = solid.spans(ray), b = mesh.spans(ray);
      if (a.count != 1 || a.interval[0].leave - a.interval[0].enter < 1e-6) continue;
      INFO("map " << i << ", ray " << r);
      REQUIRE(b.count == 1);
      CHECK(b.interval[0].enter == Approx(a.interval[0].enter).margin(1e-9));
      CHECK(b.interval[0].leave == Approx(a.interval[0].leave).margin(1e-9));
      const Vec3 p = ray.at(dice.between(-6, 6));
      if (solid.is_clear(p, 1e-6)) CHECK(solid.holds(p) == mesh.holds(p));
    }
  }
}

TEST_CASE("overlapping shells are one solid, inner shells turned inwards are cavities") {
  const auto all = meshes();
  const Mesh hollow(all[1]), overlapping(all[2]);
  const Ray x{{-5, 0.1, 0.2}, {1, 0, 0}};
  CHECK(hollow.spans(x).count == 2);
  CHECK(hollow.contains({1.5, 0, 0}));
  CHECK_FALSE(hollow.contains({0.1, 0.2, 0.3}));
  const Ray diagonal{{-5, -5.01, -5.02}, normalized({1, 1, 1})};
  CHECK(overlapping.spans(diagonal).count == 1);
  CHECK(overlapping.contains({0.5, 0.5, 0.5}));
}

TEST_CASE("what lies ahead of a ray is what its whole line crosses there") {
  Dice dice(15);
  for (const TriangleMesh& surface : meshes()) {
    const Mesh mesh(surface);
    std::vector<MeshCut> cuts;
    for (int i = 0; i < 500; ++i) {
      const Ray ray = awkward_ray(surface, dice);
      const double t0 = dice.one_in(2) ? 0 : dice.between(0, 3);
      std::vector<double> whole, ahead;
      const Spans spans = mesh.spans(ray);
      for (int k = 0; k < spans.count; ++k) {
        for (const double t : {spans.interval[static_cast<std::size_t>(k)].enter,
                               spans.interval[static_cast<std::size_t>(k)].leave}) {
          if (t >= t0 && t < 4) whole.push_back(t);
        }
      }
      mesh.crossings(ray, t0, 4, cuts, [&](double t, bool) {
        ahead.push_back(t);
        return true;
      });
      REQUIRE(ahead == whole);
      // The same from t = 0 on, where the ray may start inside.
      std::vector<double> kept;
      const Spans later = mesh.spans_ahead(ray, cuts);
      for (int k = 0; k < later.count; ++k) {
        const auto [enter, leave] = later.interval[static_cast<std::size_t>(k)];
        REQUIRE((k == 0 || enter >= 0));
        for (const double t : {enter, leave}) {
          if (t >= t0 && t < 4) kept.push_back(t);
        }
      }
      REQUIRE(kept == whole);
    }
  }
}

TEST_CASE("a cell without a triangle is inside or outside, and told so") {
  const Mesh ring(closed(ring_polygons(2, 0.5, 24, 16)));
  CHECK(ring.classify({{-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}}) == CellSide::kOutside);
  CHECK(ring.classify({{1.95, -0.05, -0.05}, {2.05, 0.05, 0.05}}) == CellSide::kInside);
  CHECK(ring.classify({{1, -0.5, -0.5}, {2, 0.5, 0.5}}) == CellSide::kCrosses);
  CHECK(ring.classify(Aabb::everything()) == CellSide::kCrosses);
  CHECK(ring.classify({{-kInf, -kInf, 1}, {kInf, kInf, kInf}}) == CellSide::kOutside);
}
