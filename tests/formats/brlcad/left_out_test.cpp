// What of a database is left out or drawn otherwise, and what is said of it.
#include <string>
#include <vector>

#include "reading.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

const std::string kSphere = "title t\nput s ell V {0 0 0} A {2 0 0} B {0 2 0} C {0 0 2}\n";
const std::string kRegion = "put a.r comb region yes tree {l s}\n";

BrlcadResult read(const std::string& text) {
  BrlcadResult result = read_brlcad(text);
  for (const auto& e : result.errors) UNSCOPED_INFO(e.where << ": " << e.text);
  REQUIRE(result.scene);
  return result;
}
std::vector<std::string> names_of(const Scene& scene) {
  std::vector<std::string> names;
  for (const SceneObject& o : scene.objects) names.push_back(o.name);
  return names;
}

}  // namespace

TEST_CASE("combinations that contain themselves and aren't named elsewhere are told of") {
  const std::string circles =
      "put a comb region no tree {u {l b} {l s}}\nput b comb region no tree {l a}\n"
      "put c comb region yes tree {l c}\n";
  const std::string ball = "put s ell V {0 0 0} A {2 0 0} B {0 2 0} C {0 0 2}\n";
  const BrlcadResult result =
      read_brlcad("title t\n" + ball + circles + "put r comb region yes tree {l s}\n");
  REQUIRE(result.scene);
  CHECK(result.scene->objects.size() == 1);
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].leaves_out);
  CHECK_THAT(result.warnings[0].text,
             Catch::Contains("3 combinations are left out") && Catch::Contains("a, b, c"));
  CHECK_FALSE(read_brlcad("title t\n" + ball + circles).scene);
}

TEST_CASE("a solid of a kind that isn't read leaves out its regions only, in one line a kind") {
  const BrlcadResult result = read(
      kSphere + kRegion +
      "put d dsp file x\nput p bot mode plate V {{0 0 0} {1 0 0} {0 1 0}} F {{0 1 2}}\n"
      "put b.r comb region yes tree {u {l s} {l d}}\nput c.r comb region yes tree {- {l s} {l d}}\n"
      "put d.r comb region yes tree {l p}\n");
  CHECK(names_of(*result.scene) == std::vector<std::string>{"a.r"});
  REQUIRE(result.warnings.size() == 2);
  CHECK(result.warnings[0].text ==
        "1 region is left out (bot in plate mode is not supported): d.r");
  CHECK(result.warnings[1].text == "2 regions are left out (dsp is not supported): b.r, c.r");
  // --strict refuses what is left out.
  CHECK(result.warnings[0].leaves_out);
  CHECK(result.warnings[1].leaves_out);
}

TEST_CASE("a cut above regions that can't be built leaves out the regions that it cuts") {
  const BrlcadResult result =
      read(kSphere + kRegion + "put b.r comb region yes tree {l s}\nput d dsp file x\n" +
           "put top comb region no tree {u {- {l b.r} {l d}} {l a.r}}\n");
  CHECK(names_of(*result.scene) == std::vector<std::string>{"a.r"});
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].text == "1 region is left out (dsp is not supported): b.r");
}

TEST_CASE("nothing is left of regions that are intersected with a solid without volume") {
  const BrlcadResult result = read(
      kSphere + kRegion +
      "put flat ell V {0 0 0} A {2 0 0} B {0 2 0} C {0 0 0}\nput b.r comb region yes tree {l s}\n"
      "put c.r comb region yes tree {l s}\nput both comb region no tree {n {l b.r} {l flat}}\n"
      "put less comb region no tree {- {l c.r} {l flat}}\n");
  CHECK(names_of(*result.scene) == std::vector<std::string>{"a.r", "c.r"});
}

TEST_CASE("air regions are left out with a count, which is no fault") {
  const BrlcadResult result =
      read(kSphere + kRegion + "put b.r comb region yes air 1 tree {l s}\n" +
           "put c.r comb region yes tree {l s}\nattr set c.r aircode 2\n");
  CHECK(names_of(*result.scene) == std::vector<std::string>{"a.r"});
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].text == "2 air regions are left out: b.r, c.r");
  CHECK_FALSE(result.warnings[0].leaves_out);
}

TEST_CASE("solids without volume are told of once a reason, with the first names") {
  std::string text = kSphere + kRegion + "put x.r comb region yes tree {u {l s} ";
  std::string tree = "{l t0}", solids;
  for (int i = 0; i < 5; ++i) {
    const std::string name = "t" + std::to_string(i);
    solids += "put " + name + " tor V {0 0 0} H {0 0 1} r_a 0 r_h 1\n";
    if (i > 0) tree = "{u " + tree + " {l " + name + "}}";
  }
  const BrlcadResult result = read(text + tree + "}\n" + solids);
  CHECK(result.scene->objects.size() == 2);
  REQUIRE(result.warnings.size() == 1);
  CHECK(result.warnings[0].text ==
        "5 solids are left out (a radius or its axis is zero): t0, t1, t2, …");
}

TEST_CASE("a member whose matrix has a tail of rounding is where it says") {
  const auto placed = [](const std::string& tail) {
    return kSphere + "put a.r comb region yes tree {l s {1 0 0 5 0 1 0 0 0 0 1 0 " + tail +
           " 0.5}}\n";
  };
  const BrlcadResult result = read(placed("4e-9 0 -4e-9"));
  CHECK(result.warnings.empty());
  CHECK(holds(*result.scene, 10, 0, 0));
  CHECK(holds(*result.scene, 13.9, 0, 0));
  CHECK_FALSE(holds(*result.scene, 5, 0, 0));
}

TEST_CASE("a member whose matrix is no affine map leaves out its region, at any level") {
  const std::string broken = " {1 0 0 0 0 1 0 0 0 0 1 0 0.001 0 0 1}";
  const BrlcadResult result =
      read(kSphere + kRegion + "put b.r comb region yes tree {u {l s} {l s" + broken + "}}\n" +
           "put top comb region no tree {u {l a.r} {l a.r" + broken + "}}\n");
  CHECK(names_of(*result.scene) == std::vector<std::string>{"a.r"});
  REQUIRE(result.warnings.size() == 2);
  CHECK(result.warnings[0].text ==
        "1 member is left out (their matrix is no invertible affine map): top/a.r");
  CHECK(result.warnings[1].text ==
        "1 region is left out (a member's matrix is no invertible affine map): b.r");
}

TEST_CASE("a region's own or inherited colour wins over the table, which fills in where none is") {
  const std::string table = "color 1000 1999 0 255 0 {}\ncolor 1500 1600 0 0 255 {}\n";
  const auto color_of = [&](const std::string& region, const std::string& group) {
    const BrlcadResult result =
        read(table + kSphere + "put r comb region yes tree {l s}\n" + "attr set r region R " +
             region + "\nput g comb region no tree {l r}\n" + group);
    return result.scene->materials.at(result.scene->objects[0].material).material.color;
  };
  CHECK(color_of("region_id 1200 rgb 255/0/0", "") == Rgb{1, 0, 0});
  CHECK(color_of("region_id 1200", "attr set g rgb 255/0/0\n") == Rgb{1, 0, 0});
  CHECK(color_of("region_id 1200", "") == Rgb{0, 1, 0});
  CHECK(color_of("region_id 1550", "") == Rgb{0, 0, 1});
  CHECK(color_of("region_id 3000", "") == Rgb{1, 1, 1});
}
