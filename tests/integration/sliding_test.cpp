// Boundaries that slide while real processes render: the picture is that of fixed ones.
#include "catch.hpp"
#include "integration/sandbox.hpp"

namespace graycube {
namespace {

/// The bytes of the EXR that a render of the scene writes; its statistics are in s.json.
std::string picture(Sandbox& sandbox, const char* scene, const Arguments& options) {
  Arguments arguments{"render",  scene_file(scene).string(),
                      "-o",      "out.exr",
                      "--size",  "256x192",
                      "--stats", "s.json",
                      "-q"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome o = sandbox.run(arguments);
  INFO(o.err);
  REQUIRE(o.status == 0);
  return file_bytes(sandbox / "out.exr");
}

/// Renders until boundaries have slid, as it depends on how quick the frontal is whether they do.
void check_sliding(const char* scene, Arguments options) {
  constexpr int kMostTries = 10;
  Sandbox sandbox;
  const std::string expected = picture(sandbox, scene, {"--algorithm", "serial"});
  options.insert(options.end(), {"--algorithm", "macro", "--boundaries", "sliding"});
  for (int tries = 0; tries < kMostTries; ++tries) {
    INFO(scene << ", try " << tries);
    CHECK((picture(sandbox, scene, options) == expected));
    const auto stats = sandbox.json("s.json");
    CHECK(stats["malformed_drops"] == 0);
    REQUIRE(stats["choices"]["boundaries"] == "sliding");
    CHECK(stats["sliding"]["generations_peak"] <= 2);
    if (stats["sliding"]["slides"] > 0) {
      CHECK(stats["sliding"]["slices"] > 0);
      CHECK(stats["sliding"]["slice_bytes"] > 0);
      CHECK(stats["sliding"]["recut_s"] > 0);
      CHECK(sandbox.processes().empty());
      CHECK(sandbox.temporary_files().empty());
      return;
    }
  }
  FAIL(scene << ": boundaries never slid");
}

TEST_CASE("between mirrors boundaries slide, and the picture is the same") {
  check_sliding("mirrors.json", {"-n", "4", "--partition", "regular", "--shadows", "forward"});
}
TEST_CASE("through glass boundaries slide, and the picture is the same") {
  check_sliding("glass.json", {"-n", "8", "--partition", "regular", "--returns", "sender"});
}
TEST_CASE("orthographic pictures are the same with sliding boundaries") {
  check_sliding("ortho.json", {"-n", "4", "--partition", "regular", "--threads", "2"});
}
TEST_CASE("a thousand objects are cut anew, and the picture is the same") {
  check_sliding("scatter1000.json", {"-n", "16", "--sums", "tree"});
}

TEST_CASE("boundaries that can't slide are refused in words") {
  Sandbox sandbox;
  const Outcome o = sandbox.run({"render", scene_file("mirrors.json").string(), "--algorithm",
                                 "macro", "--boundaries", "sliding", "--scatter", "2"});
  CHECK(o.status == 2);
  CHECK(o.err.find("--boundaries: sliding goes with one macro-region for each node") !=
        std::string::npos);
}

}  // namespace
}  // namespace graycube
