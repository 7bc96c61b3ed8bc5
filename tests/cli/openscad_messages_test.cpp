#include "cli/openscad/messages.hpp"

#include "catch.hpp"
#include "cli/openscad/model_view.hpp"
#include "file_ending.hpp"

namespace graycube {
namespace {

TEST_CASE("warnings of one kind are one, with a count, and echoes stay as they are") {
  std::string log;
  for (int i = 1; i <= 30; ++i) {
    log += "WARNING: Ignoring unknown variable 'x" + std::to_string(i) + "' in file m.scad, line " +
           std::to_string(i) + "\nTRACE: called by 'm' in file m.scad, line 99\n";
  }
  log += "ECHO: 1\nECHO: 2\nECHO: 1\nGeometries in cache: 1\nDEPRECATED: old\n";
  OpenscadMessages messages;
  messages.read(log, kOpenscadViewMark);
  CHECK(messages.errors().empty());
  CHECK(messages.take_warnings() ==
        std::vector<std::string>{"WARNING: Ignoring unknown variable 'x1' in file m.scad, line 1 "
                                 "(and 29 more like it)",
                                 "DEPRECATED: old", "ECHO: 1 (and 1 more like it)", "ECHO: 2"});
}

TEST_CASE("an error comes with how it came to be, whatever else is said") {
  OpenscadMessages messages;
  messages.read("ECHO: 1\nERROR: Assertion failed\nTRACE: called by 'a'\nECHO: 2\nTRACE: no\n",
                "X");
  CHECK(messages.errors() ==
        std::vector<std::string>{"ERROR: Assertion failed", "TRACE: called by 'a'"});
}

TEST_CASE("what a run has trouble with is told without the name of its folder") {
  CHECK(openscad_troubles(
            "WARNING: Can't open DXF file '/tmp/f/a.dxf'.\nECHO: 1\nWARNING: Ignoring "
            "unknown module 'fill' in file ../tmp/f/part.csg, line 2\n",
            "/tmp/f") == std::vector<std::string>{"WARNING: Can't open DXF file 'a.dxf'.",
                                                  "WARNING: Ignoring unknown module 'fill'"});
}

TEST_CASE("a model sets its view by values that aren't the program's, or by an assignment") {
  const std::string_view unset = "[[0, 0, 0], [0, 0, 0], 500, 22.5]";
  CHECK_FALSE(openscad_view(unset, "cube(1); if ($vpr == [0, 0, 0]) cube(2);"));
  CHECK_FALSE(openscad_view("undef", "$vpd = 7;"));
  const auto far = openscad_view("[[0, 0, 0], [0, 0, 0], 77, 22.5]", "include <view.scad>");
  REQUIRE(far);
  CHECK(far->distance == 77);
  // What isn't set is as the camera has it.
  CHECK(far->rotation == Vec3{55, 0, 25});
  const auto above = openscad_view(unset, "$vpr = [0, 0, 0];");
  REQUIRE(above);
  CHECK(above->rotation == Vec3{0, 0, 0});
  CHECK(above->distance == 140);
}

TEST_CASE("endings of names are the same in capitals") {
  CHECK(has_ending("A.SCAD", ".scad"));
  CHECK(has_ending("b.Scad", ".scad"));
  CHECK_FALSE(has_ending("scad", ".scad"));
  CHECK(ending_of("a.B.ExR") == ".exr");
}

}  // namespace
}  // namespace graycube
