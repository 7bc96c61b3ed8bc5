// One scene, one picture: byte for byte, whatever computes it.
#include <catch2/catch.hpp>

#include "integration/sandbox.hpp"

namespace graycube {
namespace {

/// The pictures' size here: small enough for a quick test, large enough for every macro-region of
/// 32 nodes.
constexpr const char* kSize = "96x64";
/// For pictures whose pixels take many rays.
constexpr const char* kSmallSize = "64x48";

/// The bytes of the EXR that a render of the scene leaves.
std::string picture(Sandbox& sandbox, const std::string& scene, const char* size,
                    const Arguments& options) {
  Arguments arguments{"render", scene_file(scene).string(), "-o", "out.exr", "--size", size, "-q"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  const Outcome o = sandbox.run(arguments);
  INFO(o.err);
  REQUIRE(o.status == 0);
  const std::string bytes = file_bytes(sandbox / "out.exr");
  REQUIRE_FALSE(bytes.empty());
  return bytes;
}

void check_identity(const std::string& scene, const char* size = kSize, const Arguments& also = {}) {
  Sandbox sandbox;
  const auto with_also = [&](Arguments way) {
    way.insert(way.end(), also.begin(), also.end());
    return way;
  };
  const std::string reference = picture(sandbox, scene, size, with_also({"--algorithm", "serial"}));
  std::vector<Arguments> ways{{"--algorithm", "serial", "--threads", "2"},
                              {"--algorithm", "auto"},
                              {"--algorithm", "macro", "-n", "4", "--threads", "2"},
                              {"--algorithm", "roth", "-n", "4", "--threads", "2"}};
  for (const char* grain : {"pixel", "line", "tile"}) {
    ways.push_back({"--algorithm", "roth", "-n", "4", "--grain", grain});
  }
  for (const char* nodes : {"1", "2", "4", "8", "16", "32"}) {
    ways.push_back({"--algorithm", "macro", "-n", nodes});
  }
  for (const Arguments& way : ways) {
    std::string name;
    for (const std::string& word : way) name += word + " ";
    INFO(scene << " with " << name);
    CHECK((picture(sandbox, scene, size, with_also(way)) == reference));
  }
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.temporary_files().empty());
}

TEST_CASE("mirrors look the same whatever computes them") { check_identity("mirrors.json"); }
TEST_CASE("glass looks the same whatever computes it") { check_identity("glass.json", kSmallSize); }
TEST_CASE("AOVs are the same whatever computes them") {
  check_identity("first.json", kSize, {"--aov", "depth,normal,albedo,object"});
}
TEST_CASE("tori look the same whatever computes them") { check_identity("tori.json"); }
TEST_CASE("a scene on an endless floor looks the same whatever computes it") {
  check_identity("first.json");
}
TEST_CASE("an orthographic picture is the same whatever computes it") {
  check_identity("ortho.json");
}

}  // namespace
}  // namespace graycube
