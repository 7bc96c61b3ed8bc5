// Cones, elliptic rounds and partial turns take the facets with which they are flush.
#include <string>

#include "catch.hpp"
#include "formats/openscad/random_rays.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

const std::string kOval = "multmatrix([[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1.5, 0]]) ";
const std::string kCone = "cylinder($fn = 40, h = 8, r1 = 10, r2 = 6); ";

constexpr std::uint64_t kSeed = 23;

int rays_that_hit(const std::string& text) { return testing::rays_that_hit(text, kSeed); }

std::string turned(const std::string& arguments, const std::string& figure) {
  return "rotate_extrude($fn = 36, " + arguments + ") " + figure;
}
std::string raised(double z) {
  return "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, " + std::to_string(z) + "]]) ";
}

void check_flush(const std::string& part, const std::string& other) {
  testing::check_flush(part, other, kSeed);
}

TEST_CASE("a cone is flush with the facets of a hull, however it is written") {
  const std::string tapered = "linear_extrude(height = 8, scale = 0.6) circle($fn = 40, r = 10); ";
  const std::string lathe =
      "rotate_extrude($fn = 40) polygon(points = [[0, 0], [10, 0], [6, 8], [0, 8]]); ";
  const std::string pointed = "cylinder($fn = 40, h = 8, r1 = 10, r2 = 0); ";
  const std::string upside = "cylinder($fn = 40, h = 8, r1 = 0, r2 = 10); ";
  for (const std::string& part : {kCone, tapered, lathe, pointed, upside})
    check_flush(part, hull_of(part));
  check_flush(tapered, hull_of(kCone));
  check_flush(lathe, hull_of(tapered));
  check_flush(kCone, hull_of(lathe));
}

TEST_CASE("a countersink is one whatever its ends, but not with another tip or slope") {
  // Their lines all go through (0, 0, 20).
  const std::string middle = raised(2) + "cylinder($fn = 40, h = 4, r1 = 9, r2 = 7); ";
  const std::string beyond = raised(-4) + "cylinder($fn = 40, h = 24, r1 = 12, r2 = 0); ";
  check_flush(middle, hull_of(kCone));
  check_flush(kCone, hull_of(beyond));
  const std::string hull = hull_of(kCone);
  CHECK(has_round("union() { " + hull + "cylinder($fn = 40, h = 8, r1 = 9.9, r2 = 6); }"));
  CHECK(has_round("union() { " + hull + "cylinder($fn = 40, h = 8, r1 = 10, r2 = 5); }"));
  CHECK(has_round("union() { " + hull + raised(1) + kCone + "}"));
  CHECK(has_round("union() { " + hull + "cylinder($fn = 42, h = 8, r1 = 10, r2 = 6); }"));
}

TEST_CASE("a tapered figure that isn't convex has facets, with which a bore is flush") {
  const std::string funnel =
      "linear_extrude(height = 8, scale = 0.6) difference() { circle($fn = 40, r = 14); "
      "circle($fn = 40, r = 10); } ";
  CHECK_FALSE(has_round("union() { " + funnel + kCone + "}"));
  CHECK(has_round("union() { " + funnel + kAside + kCone + "}"));
  const std::string drum = "cylinder($fn = 40, h = 8, r1 = 14, r2 = 8.4); ";
  CHECK(rays_that_hit("difference() { " + drum + funnel + kCone + "}") == 0);
}

TEST_CASE("what is flattened to an oval is flush with the facets of a hull") {
  const std::string oval_ring =
      "rotate_extrude($fn = 36) multmatrix([[1, 0, 0, 8], [0, 1.5, 0, 1], [0, 0, 1, 0]]) "
      "circle($fn = 20, r = 3); ";
  const std::string plate =
      "linear_extrude(height = 8) multmatrix([[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1, 0]]) "
      "circle($fn = 40, r = 5); ";
  for (const std::string& part :
       {kOval + "cylinder($fn = 40, h = 8, r1 = 5, r2 = 5); ", kOval + "sphere($fn = 24, r = 4); ",
        kOval + "cylinder($fn = 40, h = 6, r1 = 5, r2 = 3); ", oval_ring, plate})
    check_flush(part, hull_of(part));
  check_flush(plate, hull_of(kOval + "cylinder($fn = 40, h = 8, r1 = 5, r2 = 5); "));
}

TEST_CASE("a part of a turn is flush with the facets of the whole, and of the same part") {
  const std::string wire =
      "multmatrix([[1, 0, 0, 8], [0, 1, 0, 1], [0, 0, 1, 0]]) circle($fn = 20, r = 3); ";
  const std::string outline = "polygon(points = [[4, 0], [10, 0], [10, 4], [7, 8], [4, 8]]); ";
  const std::string left = "polygon(points = [[-4, 0], [-10, 0], [-10, 4], [-7, 8], [-4, 8]]); ";
  for (const std::string& part :
       {turned("angle = 120", wire), turned("angle = 95", wire), turned("angle = 90", outline),
        turned("angle = -75", outline), turned("angle = 75", left),
        turned("angle = 100, start = 15", outline), turned("angle = 360, start = 3", outline)})
    check_flush(part, hull_of(part));
  // Steps of 10 degrees in both, from 0 and from 180 degrees on.
  check_flush(turned("angle = 120", wire), hull_of(turned("angle = 360", wire)));
  const std::string boss = "cylinder($fn = 36, h = 4, r1 = 10, r2 = 10); " + raised(4) +
                           "cylinder($fn = 36, h = 4, r1 = 10, r2 = 7); ";
  check_flush(turned("angle = 90", outline), hull_of(boss));
}

TEST_CASE("a part of a turn stays round beside one that starts elsewhere or has other steps") {
  const std::string outline = "polygon(points = [[4, 0], [10, 0], [10, 8], [4, 8]]); ";
  const std::string part = turned("angle = 95", outline);
  CHECK(has_round("union() { " + part + hull_of(turned("angle = 100", outline)) + "}"));
  CHECK(has_round("union() { " + part + hull_of(turned("angle = 95, start = 5", outline)) + "}"));
  CHECK_FALSE(has_round("union() { " + part + hull_of(part) + "}"));
}

TEST_CASE("a ring is flush with an outline of facets that is turned, and both are of facets then") {
  const auto at_10 = [](const std::string& figure) {
    return "multmatrix([[1, 0, 0, 10], [0, 1, 0, 0], [0, 0, 1, 0]]) " + figure;
  };
  const std::string disc = at_10("circle($fn = 24, r = 3); ");
  // Of a circle and an oval there is no exact hull.
  const std::string egg = "hull() { " + disc +
                          "multmatrix([[1, 0, 0, 14], [0, 2, 0, 0], [0, 0, 1, 0]]) circle($fn = "
                          "24, r = 1); } ";
  for (const char* arguments : {"angle = 360", "angle = 120"})
    check_flush(turned(arguments, disc), turned(arguments, egg));
  CHECK(has_round("union() { " + turned("angle = 360", at_10("circle($fn = 24, r = 2.9); ")) +
                  turned("angle = 360", egg) + "}"));
}

TEST_CASE("a post stays round below an extrusion that is a mesh because it shrinks") {
  const std::string funnel =
      "linear_extrude(height = 8, scale = 0.6) difference() { circle($fn = 40, r = 14); "
      "circle($fn = 40, r = 10); } ";
  CHECK(has_round(funnel + "cylinder($fn = 40, h = 8, r1 = 14, r2 = 14); "));
}

}  // namespace
}  // namespace graycube
