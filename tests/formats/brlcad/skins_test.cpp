// A solid that is cut off is larger on all sides by rt's tolerance, whatever its kind.
#include <string>
#include <vector>

#include "formats/brlcad/solids.hpp"
#include "model.hpp"
#include "reading.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// A place on a solid's surface and the way out of the solid there.
struct Place {
  Vec3 at, out;
};
struct Sample {
  std::string solid;
  std::vector<Place> places;
};

constexpr Vec3 kX{1, 0, 0}, kY{0, 1, 0}, kZ{0, 0, 1};

const std::vector<Sample> kSamples{
    {"arb8 V1 {0 0 0} V2 {9 0 0} V3 {9 9 0} V4 {0 9 0} V5 {0 0 9} V6 {9 0 9} V7 {9 9 9} V8 {0 9 9}",
     {{{4, 4, 9}, kZ}, {{4, 4, 0}, -kZ}, {{9, 4, 4}, kX}}},
    {"tgc V {0 0 0} H {6 0 16} A {8 0 0} B {0 8 0} C {8 0 0} D {0 8 0}",
     {{{7, 1, 16}, kZ}, {{1, 1, 0}, -kZ}, {{3, 8, 8}, kY}}},
    {"tgc V {0 0 0} H {0 0 16} A {9 0 0} B {0 4 0} C {3 0 0} D {0 8 0}",
     {{{1, 1, 16}, kZ}, {{1, 1, 0}, -kZ}}},
    {"ell V {0 0 0} A {8 0 0} B {0 5 0} C {0 0 3}", {{{8, 0, 0}, kX}, {{0, 0, 3}, kZ}}},
    {"superell V {0 0 0} A {8 0 0} B {0 5 0} C {0 0 3} n 1 e 1", {{{0, 5, 0}, kY}}},
    {"tor V {0 0 0} H {0 0 1} r_a 8 r_h 3", {{{11, 0, 0}, kX}, {{8, 0, 3}, kZ}}},
    {"eto V {0 0 0} N {0 0 1} C {4 0 0} r 10 r_d 2", {{{14, 0, 0}, kX}, {{10, 0, 2}, kZ}}},
    {"half N {0 0 2} d 6", {{{1, 1, 3}, kZ}}},
    {"arbn N 6 P0 {2 0 0 20} P1 {-1 0 0 9} P2 {0 1 0 9} P3 {0 -1 0 9} P4 {0 0 1 9} P5 {0 0 -1 9}",
     {{{10, 1, 1}, kX}, {{1, 1, -9}, -kZ}}},
    {"rpc V {-8 0 0} H {16 0 0} B {0 0 14} r 8",
     {{{0, 0, 14}, kZ}, {{0, 1, 0}, -kZ}, {{8, 1, 3}, kX}}},
    {"rhc V {-8 0 0} H {16 0 0} B {0 0 14} r 8 c 4",
     {{{0, 0, 14}, kZ}, {{0, 1, 0}, -kZ}, {{8, 1, 3}, kX}}},
    {"epa V {0 0 0} H {0 0 16} A {1 0 0} r_1 9 r_2 6", {{{0, 0, 16}, kZ}, {{1, 1, 0}, -kZ}}},
    {"ehy V {0 0 0} H {0 0 16} A {1 0 0} r_1 9 r_2 6 c 5", {{{0, 0, 16}, kZ}, {{1, 1, 0}, -kZ}}},
    {"hyp V {0 0 0} H {0 0 16} A {9 0 0} b 6 bnr 0.5",
     {{{4.5, 0, 8}, kX}, {{5, 1, 16}, kZ}, {{5, 1, 0}, -kZ}}},
    {"part V {0 0 0} H {10 0 0} r_v 6 r_h 3", {{{-6, 0, 0}, -kX}, {{13, 0, 0}, kX}}},
    {"pipe V0 {0 0 0} O0 4 I0 0 R0 0 V1 {10 0 0} O1 4 I1 0 R1 0",
     {{{5, 2, 0}, kY}, {{0, 1, 0}, -kX}, {{10, 1, 0}, kX}}},
};

/// The solid cut from a box that reaches beyond it on all sides, once as it is and once mirrored.
Scene cut_from_box(const std::string& solid, double sign) {
  return scene_of("title t\nput s " + solid +
                      "\nput b arb8 V1 {-90 -90 -90} V2 {90 -90 -90} V3 {90 90 -90} V4 {-90 90 "
                      "-90} V5 {-90 -90 90} V6 {90 -90 90} V7 {90 90 90} V8 {-90 90 90}\n"
                      "put r comb region yes tree {- {l b} {l s {" +
                      std::to_string(sign) + " 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1}}}\n",
                  {"r"});
}

}  // namespace

TEST_CASE("what a solid of any kind leaves standing is rt's tolerance away from its surface") {
  // Quadrics move by more than that where they are steep: up to eight times as much.
  constexpr double kNear = 0.8 * kBrlcadSkin, kFar = 8 * kBrlcadSkin;
  for (const Sample& sample : kSamples) {
    for (const double sign : {1.0, -1.0}) {
      INFO(sample.solid << ", x times " << sign);
      const Scene scene = cut_from_box(sample.solid, sign);
      const auto stands = [&](const Place& place, double distance) {
        const Vec3 at = place.at + distance * place.out;
        return holds(scene, sign * at.x, at.y, at.z);
      };
      for (const Place& place : sample.places) {
        CAPTURE(place.at.x, place.at.y, place.at.z);
        CHECK_FALSE(stands(place, -1));
        CHECK_FALSE(stands(place, kNear));
        CHECK(stands(place, kFar));
      }
    }
  }
}
