// What a log's file gets, and what becomes of lines that can't be written.
#include "process/log_thread.hpp"

#include <sys/stat.h>

#include <fstream>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "catch.hpp"
#include "process/log_line.hpp"
#include "process/temporary_folder.hpp"

using namespace graycube;

namespace {

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

}  // namespace

TEST_CASE("a line of a log has an ISO time with its offset, and is one line") {
  const std::string line = log_line(1234567890.25, "a scene\nnamed \x1b[31m");
  const std::string time = line.substr(0, line.find(' '));
  REQUIRE(time.size() == std::string("2009-02-13T23:31:30.250+00:00").size());
  CHECK(time.substr(0, 5) == "2009-");
  CHECK(time.substr(13, 1) == ":");
  CHECK(time.substr(17, 6) == "30.250");
  CHECK(line.substr(line.find(' ')) == " a scene\\nnamed \\x1b[31m\n");
  CHECK(log_line(0, std::string(5000, 'x')).size() < kMaxLogText + 40);
}

TEST_CASE("lines are appended in order to a file that only its owner can read") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "log";
  std::ofstream(file) << "earlier\n";
  ::chmod(file.c_str(), 0644);
  {
    LogThread log(file, "begins");
    for (int i = 0; i < 100; ++i) log.write(i, "line " + std::to_string(i), false);
  }
  struct stat status {};
  REQUIRE(::stat(file.c_str(), &status) == 0);
  CHECK((status.st_mode & 0777) == 0600);
  const auto lines = lines_of(file);
  REQUIRE(lines.size() == 102);
  CHECK(lines[0] == "earlier");
  CHECK(lines[1].ends_with(" begins"));
  for (std::size_t i = 0; i < 100; ++i) CHECK(lines[i + 2].ends_with(" line " + std::to_string(i)));
}

TEST_CASE("a log that can't be written is refused at once, and why") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(LogFile("/dev/full", "begins"), "/dev/full: No space left on device");
  CHECK_THROWS_WITH(LogFile(folder / "none/log", "begins"),
                    (folder / "none/log").string() + ": No such file or directory");
  CHECK_THROWS_AS(LogFile(folder.path(), "begins"), std::runtime_error);
}

TEST_CASE("lines of two processes that append to one file don't mix") {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "log";
  LogFile a(file, "a begins"), b(file, "b begins");
  for (int i = 0; i < 10; ++i) {
    CHECK(a.append("from a\n").empty());
    CHECK(b.append("from b\n").empty());
  }
  const auto lines = lines_of(file);
  REQUIRE(lines.size() == 22);
  for (std::size_t i = 2; i < 22; ++i) CHECK(lines[i] == (i % 2 == 0 ? "from a" : "from b"));
}
