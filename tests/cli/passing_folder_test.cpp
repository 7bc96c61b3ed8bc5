// Which folders of farms that were killed are cleared.
#include "cli/farm/passing_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <string>

#include "catch.hpp"

using namespace graycube;
namespace fs = std::filesystem;

namespace {

/// Temporary files are made in a folder of the test's as long as it lives.
class TemporaryPlace {
 public:
  TemporaryPlace() { ::setenv("TMPDIR", folder_.path().c_str(), 1); }
  ~TemporaryPlace() { was_.empty() ? ::unsetenv("TMPDIR") : ::setenv("TMPDIR", was_.c_str(), 1); }
  TemporaryPlace(const TemporaryPlace&) = delete;
  TemporaryPlace& operator=(const TemporaryPlace&) = delete;

  /// A folder that a farm has left there, with its lock's file.
  fs::path left(const std::string& name) const {
    fs::create_directory(folder_ / name);
    std::ofstream(folder_ / name / "lock") << "1\n";
    std::ofstream(folder_ / name / "jobs.sqlite") << "jobs";
    return folder_ / name;
  }

 private:
  std::string was_ = std::getenv("TMPDIR") != nullptr ? std::getenv("TMPDIR") : "";
  TemporaryFolder folder_;
};

/// Holds the lock of a file as another process would.
class Held {
 public:
  explicit Held(const fs::path& file) : descriptor_(::open(file.c_str(), O_RDONLY)) {
    REQUIRE(::flock(descriptor_, LOCK_EX | LOCK_NB) == 0);
  }
  ~Held() { ::close(descriptor_); }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

 private:
  int descriptor_;
};

}  // namespace

TEST_CASE("folders of farms that were killed are cleared, and others stay") {
  const TemporaryPlace place;
  const fs::path killed = place.left("graycube-jobs-killed"), used = place.left("graycube-jobs-b"),
                 other = place.left("graycube-other");
  const Held lock(used / "lock");
  clear_left_passing_folders();
  CHECK_FALSE(fs::exists(killed));
  CHECK(fs::exists(used / "jobs.sqlite"));
  CHECK(fs::exists(other / "jobs.sqlite"));
}

TEST_CASE("the folder of a farm that is about to begin, or between two frontals, isn't cleared") {
  const TemporaryPlace place;
  const PassingFolder folder;
  clear_left_passing_folders();
  CHECK(fs::exists(folder.path()));
  std::ofstream(folder.path() / "lock") << "1\n";
  clear_left_passing_folders();
  CHECK(fs::exists(folder.path()));
}

TEST_CASE("a link among temporary files isn't followed to what it names") {
  const TemporaryPlace place;
  const fs::path elsewhere = place.left("elsewhere");
  fs::create_directory_symlink(elsewhere, elsewhere.parent_path() / "graycube-jobs-link");
  clear_left_passing_folders();
  CHECK(fs::exists(elsewhere / "jobs.sqlite"));
}

TEST_CASE("a folder that is used is removed in the end") {
  const TemporaryPlace place;
  fs::path path;
  {
    const PassingFolder folder;
    path = folder.path();
    CHECK(fs::exists(path));
  }
  CHECK_FALSE(fs::exists(path));
}
