// Round solids take the facets of the hull with which they are flush.
#include <algorithm>
#include <string>

#include "catch.hpp"
#include "formats/openscad/random_rays.hpp"
#include "formats/openscad/reading.hpp"

namespace graycube {
namespace {

using namespace graycube::testing;

const std::string kPost = "cylinder($fn = 40, h = 8, r1 = 10, r2 = 10); ";
const std::string kBall = "sphere($fn = 24, r = 6); ";
/// A cylinder that lies across: with an upright one, there is no exact hull.
const std::string kAcross =
    "multmatrix([[1, 0, 0, 30], [0, 0, -1, 0], [0, 1, 0, 4], [0, 0, 0, 1]]) "
    "cylinder($fn = 30, h = 10, r1 = 4, r2 = 4); ";
constexpr std::uint64_t kSeed = 5;

int rays_that_hit(const std::string& text) { return testing::rays_that_hit(text, kSeed); }

TEST_CASE("nothing is left of a round part that a faceted hull of it is taken from") {
  for (const std::string& part : {kPost, kBall}) {
    const std::string hull = "hull() { " + part + kAcross + "} ";
    for (const std::string& turn : {std::string{}, kTurned}) {
      CHECK(rays_that_hit(turn + "difference() { " + part + hull + "}") == 0);
      // With the hull moved aside, nothing is cut off, and the part is there as it was.
      CHECK(rays_that_hit(turn + "difference() { " + part + kAside + hull + "}") > 100);
    }
  }
}

TEST_CASE("a bore goes by the facets of its boss whatever its ends, and however it is reached") {
  const std::string hull = "hull() { " + kPost + kAcross + "} ";
  const std::string lower =
      "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, -1, 5]]) "
      "cylinder($fn = 40, h = 3, r1 = 10, r2 = 10, center = false); ";
  CHECK(rays_that_hit("difference() { " + lower + hull + "}") == 0);
  CHECK_FALSE(has_round("difference() { " + hull + lower + "}"));
  // Turned by half a facet it is another solid.
  const std::string half_turned =
      "multmatrix([[0.996917, -0.0784591, 0, 0], [0.0784591, 0.996917, 0, 0], [0, 0, 1, 0]]) ";
  CHECK(has_round("difference() { " + hull + half_turned + lower + "}"));
  CHECK(has_round("difference() { " + hull + kAside + lower + "}"));
}

TEST_CASE("hulls that could be exact take the facets of those that they are flush with") {
  const std::string slot = "hull() { " + kPost + kAside + kPost + "} ";
  CHECK(has_round(slot));
  const std::string both = "difference() { hull() { " + kPost + kAcross + "} " + slot + "} ";
  CHECK_FALSE(has_round(both));
  // The slot's other end counts, too, and so does a solid that is flush with it.
  CHECK_FALSE(has_round(both + kAside + kPost));
  CHECK(rays_that_hit("difference() { " + kPost + "union() { " + both + slot + "} }") == 0);
}

TEST_CASE("what is round stays so beside hulls that are exact or touch it nowhere") {
  CHECK(has_round("union() { hull() { " + kPost + kAside + kPost + "} " + kPost + "}"));
  CHECK(has_round("union() { hull() { " + kAcross + kAside + kPost + "} " + kPost + "}"));
}

}  // namespace
}  // namespace graycube
