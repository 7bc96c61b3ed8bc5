#include "spelling.hpp"

#include <array>
#include <string_view>

#include "catch.hpp"

using namespace graycube;

TEST_CASE("edit distance counts insertions, deletions, replacements and swaps") {
  REQUIRE(edit_distance("", "") == 0);
  REQUIRE(edit_distance("", "abc") == 3);
  REQUIRE(edit_distance("radius", "radius") == 0);
  REQUIRE(edit_distance("raduis", "radius") == 1);
  REQUIRE(edit_distance("radus", "radius") == 1);
  REQUIRE(edit_distance("color", "colour") == 1);
  REQUIRE(edit_distance("kitten", "sitting") == 3);
}

TEST_CASE("only near words are suggested") {
  constexpr std::array<std::string_view, 4> known{"sphere", "cylinder", "child", "box"};
  REQUIRE(closest("shpere", known) == "sphere");
  REQUIRE(closest("cylindre", known) == "cylinder");
  REQUIRE(closest("children", known) == "child");
  REQUIRE(closest("bix", known) == "box");
  REQUIRE_FALSE(closest("teapot", known));
  REQUIRE_FALSE(closest("", known));
  REQUIRE(did_you_mean("teapot", known).empty());
}
