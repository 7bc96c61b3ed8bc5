// Extruded and turned circles, and rounds beside OpenSCAD's meshes, take the facets with which they
// are flush.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "catch.hpp"
#include "formats/openscad/random_rays.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

const std::string kDisc = "circle($fn = 40, r = 10); ";
const std::string kDrum = "linear_extrude(height = 8) " + kDisc;
const std::string kRing =
    "rotate_extrude($fn = 36) multmatrix([[1, 0, 0, 8], [0, 1, 0, 1], [0, 0, 1, 0], [0, 0, 0, 1]]) "
    "circle($fn = 20, r = 3); ";

constexpr double kPi = 3.14159265358979323846;

constexpr std::uint64_t kSeed = 11;

int rays_that_hit(const std::string& text, OpenscadProgram* program = nullptr) {
  OpenscadOptions options;
  options.program = program;
  return testing::rays_that_hit(text, kSeed, options);
}

/// Stands for OpenSCAD: whatever it is asked for is an upright prism of `sides` sides around a
/// circle of radius 10, from z = −20 to 20, in six digits.
struct PrismProgram : OpenscadProgram {
  explicit PrismProgram(int sides) : sides_(sides) {}
  Result evaluate(const std::string&, Format) override {
    ++asked;
    std::ostringstream text;
    text << "OFF " << 2 * sides_ << ' ' << sides_ + 2 << " 0\n";
    for (const double z : {-20, 20}) {
      for (int i = 0; i < sides_; ++i) {
        const double angle = 2 * kPi * i / sides_;
        text << 10 * std::cos(angle) << ' ' << 10 * std::sin(angle) << ' ' << z << '\n';
      }
    }
    for (int i = 0; i < sides_; ++i) {
      const int j = (i + 1) % sides_;
      text << "4 " << i << ' ' << j << ' ' << sides_ + j << ' ' << sides_ + i << '\n';
    }
    text << sides_;
    for (int i = sides_; i-- > 0;) text << ' ' << i;
    text << '\n' << sides_;
    for (int i = 0; i < sides_; ++i) text << ' ' << sides_ + i;
    text << '\n';
    return {text.str(), {}};
  }
  int asked = 0;

 private:
  int sides_;
};

TEST_CASE("nothing is left of extruded and turned circles that a faceted hull is taken from") {
  const std::string cylinder = "cylinder($fn = 40, h = 8, r1 = 10, r2 = 10); ";
  const std::string upside = "multmatrix([[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, -1, 8]]) ";
  for (const auto& [part, hull] :
       {std::pair{kDrum, hull_of(cylinder)}, std::pair{cylinder, hull_of(kDrum)},
        std::pair{upside + kDrum, hull_of(kDrum)}, std::pair{kRing, hull_of(kRing)}}) {
    for (const std::string& turn : {std::string{}, kTurned}) {
      CHECK(rays_that_hit(turn + "difference() { " + part + hull + "}") == 0);
      // With the hull moved aside, nothing is cut off, and the part is there as it was.
      CHECK(rays_that_hit(turn + "difference() { " + part + kAside + hull + "}") > 50);
    }
    CHECK_FALSE(has_round("union() { " + part + hull + "}"));
    CHECK(has_round("union() { " + part + kAside + hull + "}"));
  }
}

TEST_CASE("of a figure only the circles get facets that are flush, or tangent to such") {
  const auto extruded = [](const std::string& figure) {
    return "linear_extrude(height = 3) difference() { " + figure +
           "multmatrix([[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0]]) circle($fn = 30, r = 3); } ";
  };
  // The hole stays round.
  CHECK(has_round("union() { " + extruded(kDisc) + hull_of(kDrum) + "}"));
  const std::string slot = "hull() { " + kDisc + kAside + kDisc + "} ";
  const std::string solid = "linear_extrude(height = 3) " + slot;
  CHECK_FALSE(has_round("union() { " + solid + hull_of(kDrum) + "}"));
  // The slot's other end gets its facets as well, and so does what is flush with that.
  CHECK_FALSE(has_round("union() { " + solid + hull_of(kDrum) + kAside + kDrum + "}"));
  CHECK(has_round("union() { " + solid + kAside + kDrum + "}"));
  CHECK(rays_that_hit("difference() { " + kDrum + "union() { " + hull_of(kDrum) + solid + "} }") ==
        0);
}

TEST_CASE("a shaft of a turned outline is flush with a faceted hull of a cylinder") {
  const std::string shaft = "rotate_extrude($fn = 40) square(size = [10, 8], center = false); ";
  CHECK(rays_that_hit("difference() { " + shaft + hull_of(kDrum) + "}") == 0);
  CHECK(rays_that_hit("difference() { " + kDrum + hull_of(shaft) + "}") == 0);
}

TEST_CASE("a round is flush with OpenSCAD's mesh if they have the edges of a facet in common") {
  // The program stands for the sum, whatever is in it; a sum of a difference has no exact form.
  const std::string sum = "minkowski() { difference() { cube(9); cube(4); } " + kDrum + "} ";
  PrismProgram program(40);
  for (const std::string& turn : {std::string{}, kTurned}) {
    CHECK(rays_that_hit(turn + "difference() { " + kDrum + sum + "}", &program) == 0);
    CHECK(rays_that_hit(turn + "difference() { " + kDrum + kAside + sum + "}", &program) > 50);
  }
  // Once for each of the four files.
  CHECK(program.asked == 4);
  const std::string post = "cylinder($fn = 40, h = 3, r1 = 10, r2 = 10, center = true); ";
  CHECK_FALSE(has_round("union() { " + sum + post + "}", &program));
  // Another radius, direction, place or number of sides is another solid.
  CHECK(has_round("union() { " + sum + "cylinder($fn = 40, h = 3, r1 = 9.99, r2 = 9.99); }",
                  &program));
  CHECK(has_round("union() { " + sum + kTurned + post + "}", &program));
  CHECK(has_round("union() { " + sum + kAside + post + "}", &program));
  CHECK(has_round("union() { " + sum + "cylinder($fn = 60, h = 3, r1 = 10, r2 = 10); }", &program));
}

TEST_CASE("a boss is flush with the facets of an offset without an exact form") {
  const std::string oval =
      "multmatrix([[1, 0, 0, 15], [0, 2, 0, 10], [0, 0, 1, 0], [0, 0, 0, 1]]) circle($fn = 32, r = "
      "6); ";
  const std::string lid =
      "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 3], [0, 0, 0, 1]]) linear_extrude(height "
      "= 9) offset(r = 4, $fn = 32) { square(size = [30, 20], center = false); " +
      oval + "} ";
  const std::string boss = "cylinder($fn = 32, h = 8, r1 = 4, r2 = 4); ";
  const std::string base = "cylinder($fn = 32, h = 3, r1 = 5, r2 = 5); ";
  CHECK_FALSE(has_round("difference() { " + boss + lid + "}"));
  CHECK(rays_that_hit("difference() { " + boss + "union() { " + lid + base + "} }") == 0);
  CHECK(has_round("difference() { " + boss + kAside + lid + "}"));
  // Clipper's grid is 1e-11 wide here; the corners are the boss's to the last bits.
  const Scene scene = scene_of("union() { " + lid + boss + "}");
  const auto* prism = std::get_if<PrismShape>(&scene.objects.at(0).csg.value);
  REQUIRE(prism != nullptr);
  const double x = 4 * std::cos(1.0625 * kPi), y = 4 * std::sin(1.0625 * kPi);
  CHECK(std::any_of(prism->points.begin(), prism->points.end(), [&](const FlatPoint& p) {
    return std::fabs(p.x - x) < 1e-14 && std::fabs(p.y - y) < 1e-14;
  }));
}

TEST_CASE("a far file asks OpenSCAD once for each part") {
  PrismProgram program(40);
  OpenscadOptions options;
  options.program = &program;
  const std::string far =
      "multmatrix([[1, 0, 0, 54000], [0, 1, 0, 54000], [0, 0, 1, 20000], [0, 0, 0, 1]]) ";
  const Scene scene = scene_of(
      far + "minkowski() { difference() { cube(9); cube(4); } sphere($fn = 40, r = 2); }", options);
  CHECK(scene.objects.at(0).csg.transform);
  CHECK(program.asked == 1);
}

}  // namespace
}  // namespace graycube
