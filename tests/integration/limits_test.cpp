// Farms under limits of the system (ulimit).
#include <filesystem>

#include "catch.hpp"
#include "integration/farm.hpp"

namespace graycube {
namespace {

/// Runs the command under limits that `ulimit` sets.
Outcome run_under(Sandbox& sandbox, const std::string& limits, const std::string& arguments) {
  return sandbox.run_program(
      "/bin/sh", {"-c", limits + "; exec " + std::string(GRAYCUBE_COMMAND) + " " + arguments});
}

TEST_CASE("whatever ulimit -n says, a farm has as many descriptors as the system lets it") {
  Sandbox sandbox;
  const std::string scene = scene_file("first.json").string();
  const Outcome low =
      run_under(sandbox, "ulimit -Sn 40", "render " + scene + " -n 64 --size 64x64 -o low.exr -q");
  INFO(low.err);
  CHECK(low.status == 0);
  CHECK(sandbox.run({"render", scene, "-n", "64", "--size", "64x64", "-o", "usual.exr", "-q"})
            .status == 0);
  CHECK((file_bytes(sandbox / "low.exr") == file_bytes(sandbox / "usual.exr")));
}

TEST_CASE("a farm that doesn't fit is refused with what it needs, and leaves nothing behind") {
  Sandbox sandbox;
  const std::string scene = scene_file("first.json").string();
  const Outcome o = run_under(sandbox, "ulimit -n 100", "render " + scene + " -n 64 -o a.exr -q");
  CHECK(o.status == 1);
  CHECK(o.err.find("64 nodes need 128 open files and sockets, and the system lets a process have "
                   "100 (ulimit -Hn)") != std::string::npos);
  CHECK(sandbox.processes().empty());
  CHECK(sandbox.files().empty());
}

}  // namespace
}  // namespace graycube
