// Solids at the edge of what rt draws: radii of 0, tubes thicker than their rings, tight bends.
#include <cmath>
#include <string>

#include "formats/brlcad/solids.hpp"
#include "formats/brlcad/view.hpp"
#include "model.hpp"
#include "reading.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

Scene alone(const std::string& solid) {
  return scene_of("title t\nput " + solid + "\nput r comb region yes tree {l s}\n", {"r"});
}

}  // namespace

TEST_CASE("a particle with a radius of 0 is a cone with one round end") {
  const Scene scene = alone("s part V {0 0 0} H {0 0 30} r_v 10 r_h 0");
  CHECK(holds(scene, 0, 0, -9.9));
  CHECK(holds(scene, 0, 0, 29.9));
  CHECK_FALSE(holds(scene, 0, 0, 30.1));
  // The tangent cone from the apex: at height z its radius is (30 − z) tan(asin(10 / 30)).
  const double slope = std::tan(std::asin(1.0 / 3));
  CHECK(holds(scene, 10 * slope - 0.01, 0, 20));
  CHECK_FALSE(holds(scene, 10 * slope + 0.01, 0, 20));
  const Scene turned = alone("s part V {0 0 0} H {0 0 30} r_v 0 r_h 10");
  CHECK(holds(turned, 0, 0, 39.9));
  CHECK(holds(turned, 0, 0, 0.1));
}

TEST_CASE("the small end of a cone counts as 0 below a thousand millionth of the large one") {
  const auto shape_of = [](const std::string& c, const std::string& d) {
    return alone("s tgc V {0 0 0} H {0 0 16} A {9 0 0} B {0 4 0} C " + c + " D " + d)
        .objects.at(0)
        .csg.value;
  };
  // Both semi-axes end in a tip, so that the cone is a round one under a map.
  const auto tip = shape_of("{2e-9 0 0} ", "{0 1e-9 0}");
  REQUIRE(std::holds_alternative<ConeShape>(tip));
  CHECK(std::get<ConeShape>(tip).top_radius == 0);
  const auto edge = shape_of("{2e-9 0 0} ", "{0 1 0}");
  REQUIRE(std::holds_alternative<EllipticConeShape>(edge));
  CHECK(std::get<EllipticConeShape>(edge).top_a == 0);
}

TEST_CASE("a torus whose tube is thicker than its ring has dents, and no hole") {
  const Scene scene = alone("s tor V {0 0 0} H {0 0 1} r_a 20 r_h 25");
  CHECK(holds(scene, 0, 0, 0));
  CHECK(holds(scene, 0, 0, 14.9));
  CHECK_FALSE(holds(scene, 0, 0, 15.1));
  CHECK(holds(scene, 20, 0, 24.9));
  CHECK(holds(scene, 44.9, 0, 0));
  CHECK(holds(scene, 1, 1, 2));
}

TEST_CASE("an elliptic torus that reaches its axis is drawn until a semi-axis passes it") {
  const auto eto = [](const std::string& c, const std::string& r_d) {
    return "s eto V {0 0 0} N {0 0 1} C " + c + " r 20 r_d " + r_d;
  };
  const Scene scene = alone(eto("{20 0 20}", "10"));
  CHECK(holds(scene, 20, 0, 0));
  CHECK(holds(scene, 39, 0, 19));
  CHECK_FALSE(holds(scene, 40, 0, -19));
  CHECK(error_of("title t\nput " + eto("{21 0 20}", "10") + "\n")
            .find("its ellipse overlaps itself") != std::string::npos);
}

TEST_CASE("a pipe may bend more tightly than it is thick") {
  const auto pipe = [](const std::string& bend) {
    return alone("s pipe V0 {0 0 0} O0 10 I0 0 R0 " + bend + " V1 {50 0 0} O1 10 I1 0 R1 " + bend +
                 " V2 {50 50 0} O2 10 I2 0 R2 " + bend);
  };
  const Scene scene = pipe("3");
  CHECK(holds(scene, 20, 4.9, 0));
  CHECK(holds(scene, 45.1, 30, 0));
  // The middle of the bend is at (47, 3); its outside is 3 + 5 away.
  CHECK(holds(scene, 47 + 7.9 * std::sqrt(0.5), 3 - 7.9 * std::sqrt(0.5), 0));
  CHECK_FALSE(holds(scene, 47 + 8.1 * std::sqrt(0.5), 3 - 8.1 * std::sqrt(0.5), 0));
  CHECK(holds(pipe("0"), 49.9, 4, 0));
}

TEST_CASE("a pipe's bend begins before its point by the tangent of half the angle") {
  // A turn of 60 degrees with radius 30: from x = 50 - 30 tan(30 degrees), about (32.68, 30).
  const Scene scene = alone(
      "s pipe V0 {0 0 0} O0 4 I0 0 R0 30 V1 {50 0 0} O1 4 I1 0 R1 30 V2 {75 43.30127018922193 0} "
      "O2 4 I2 0 R2 30");
  CHECK(holds(scene, 47.68, 4.02, 0));
  CHECK(holds(scene, 32, 1.9, 0));
  CHECK(holds(scene, 33.5, 0, 1.9));
  CHECK_FALSE(holds(scene, 50, 0, 0));
}

TEST_CASE("a pipe's bore is open at its ends, and what it leaves standing when cut is flush") {
  const std::string pipe = "put s pipe V0 {0 0 0} O0 4 I0 2 R0 0 V1 {0 0 10} O1 4 I1 2 R1 0\n";
  const Scene tube = scene_of("title t\n" + pipe + "put r comb region yes tree {l s}\n", {"r"});
  CHECK(holds(tube, 1.5, 0, 0));
  CHECK_FALSE(holds(tube, 0.5, 0, 0));
  CHECK_FALSE(holds(tube, 0.5, 0, 10));
  // The bore goes on beyond both ends by the skin; along it z goes from 0 to 1.
  const CsgNode& bore = std::get<OperationNode>(tube.objects[0].csg.value).children.at(1);
  REQUIRE(bore.transform);
  CHECK(bore.transform->point({0, 0, 0}).z == Approx(-kBrlcadSkin).margin(1e-9));
  CHECK(bore.transform->point({0, 0, 1}).z == Approx(10 + kBrlcadSkin).margin(1e-9));
  const Scene cut = scene_of("title t\n" + pipe +
                                 "put b arb8 V1 {-9 -9 0} V2 {9 -9 0} V3 {9 9 0} V4 {-9 9 0} V5 "
                                 "{-9 -9 10} V6 {9 -9 10} V7 {9 9 10} V8 {-9 9 10}\n"
                                 "put r comb region yes tree {- {l b} {l s}}\n",
                             {"r"});
  CHECK(holds(cut, 0.5, 0, 0));
  CHECK_FALSE(holds(cut, 1.5, 0, 0));
  // The rod in the bore is not thinner than the bore.
  CHECK(holds(cut, 0.9999, 0, 5));
}

TEST_CASE("the faces of a mesh that is cut off move outwards by the skin, a spike's tip by eight") {
  const auto grown = [](const Vec3& tip) {
    BrlcadMesh mesh;
    mesh.vertices = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 2, 0}, tip};
    mesh.faces = {{0, 2, 1}, {0, 3, 2}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
    const BrlcadNode node = brlcad_mesh_node(mesh, {}, 0.01);
    REQUIRE(node.node);
    return std::get<MeshShape>(node.node->value).mesh.points;
  };
  const std::vector<Vec3> points = grown({0.5, 0.5, 4});
  REQUIRE(points.size() == 5);
  // Where three planes meet, each is as far off as the others: below, y = 0, and a slope.
  const Vec3 slope = normalized(cross(Vec3{0.5, 0.5, 4}, Vec3{0, 2, 0}));
  const Vec3 shift = points[0];
  CHECK(-shift.z == Approx(0.01).epsilon(1e-4));
  CHECK(std::fabs(dot(shift, slope)) == Approx(0.01).epsilon(1e-4));
  CHECK(std::fabs(dot(shift, normalized(Vec3{0, 4, -0.5}))) == Approx(0.01).epsilon(1e-4));
  const Vec3 tip = grown({0.5, 0.5, 400})[4];
  CHECK(length(tip - Vec3{0.5, 0.5, 400}) == Approx(0.08));
}

TEST_CASE("a view is framed by bounds that are rounded outwards to whole millimetres") {
  const BrlcadView view = brlcad_view(35, 25, {{-0.05, -0.15, -4.25}, {0.65, 8.55, 0.45}});
  CHECK(view.size == Approx(std::sqrt(4.0 + 100 + 36)).epsilon(1e-15));
  const BrlcadView exact = brlcad_view(35, 25, {{-1, -1, -5}, {1, 9, 1}});
  CHECK(view.camera == exact.camera);
}
