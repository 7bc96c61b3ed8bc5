// What `graycube up` tells, in its log and at its terminal.
#include <sys/stat.h>

#include <algorithm>

#include "catch.hpp"
#include "integration/farm.hpp"

namespace graycube {
namespace {

std::string first() { return scene_file("first.json").string(); }

/// The lines without their times.
std::vector<std::string> events_of(const std::string& text) {
  std::vector<std::string> events;
  for (const std::string& line : lines_of(text)) {
    const std::size_t space = line.find(' ');
    REQUIRE(space == std::string("2009-02-13T23:31:30.250+00:00").size());
    events.push_back(line.substr(space + 1));
  }
  return events;
}

}  // namespace

TEST_CASE("a farm's log tells of its jobs, and so does its terminal; nobody forges a line of it") {
  Sandbox sandbox;
  const std::string name = "a\n2026 job 9\x1b[31m: done.json";
  sandbox.write(name, file_bytes(first()));
  {
    Farm farm(sandbox, {"--log", "farm.log"});
    ok(sandbox, {"submit", name, "--size", "16x16", "--wait", "-q"});
    ok(sandbox, {"down"});
    const Outcome o = farm.up().wait(10s);
    const auto shown = events_of(o.err);
    CHECK(std::ranges::count(shown, "job 1: submitted, \"a 2026 job 9 [31m: done.json\"") == 1);
    CHECK(shown.back() == "farm: goes down");
  }
  const auto logged = events_of(file_bytes(sandbox / "farm.log"));
  REQUIRE(logged.size() == 7);
  CHECK(logged[0].starts_with("farm: 'graycube up' begins, process "));
  CHECK(logged[1].starts_with("frontal: process "));
  CHECK(logged[5].starts_with("job 1: done after "));
  struct stat status {};
  REQUIRE(::stat((sandbox / "farm.log").c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0600);
  // Another farm goes on with the file.
  Farm farm(sandbox, {"--log", "farm.log", "--quiet"});
  ok(sandbox, {"down"});
  CHECK(farm.up().wait(10s).err.empty());
  CHECK(events_of(file_bytes(sandbox / "farm.log")).size() > logged.size());
}

TEST_CASE("a log that can't be written is refused before anything is started") {
  Sandbox sandbox;
  const std::pair<const char*, const char*> refused[] = {
      {"/dev/full", "graycube: usage: --log: /dev/full: No space left on device\n"},
      {"none/log", "graycube: usage: --log: none/log: No such file or directory\n"},
      {".", "graycube: usage: --log: .: Is a directory\n"}};
  for (const auto& [file, told] : refused) {
    const Outcome o = sandbox.run({"up", "-n", "2", "--log", file});
    CHECK(o.status == 2);
    CHECK(o.err == told);
  }
  CHECK(sandbox.temporary_files().empty());
}

}  // namespace graycube
