#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "catch.hpp"
#include "film/picture_files.hpp"
#include "process/temporary_folder.hpp"

using namespace graycube;
namespace fs = std::filesystem;

namespace {

struct Outcome {
  int status = -1;
  std::string output;
};

/// A folder with pictures, and the tool run in it.
class Bench {
 public:
  fs::path operator/(const char* name) const { return folder_ / name; }
  Outcome compare(const std::string& arguments) const {
    const std::string command =
        "cd " + folder_.path().string() + " && " COMPARE_PICTURES " " + arguments + " 2>&1";
    std::FILE* pipe = ::popen(command.c_str(), "r");
    REQUIRE(pipe != nullptr);
    Outcome outcome;
    std::array<char, 256> line{};
    while (std::fgets(line.data(), line.size(), pipe) != nullptr) outcome.output += line.data();
    const int status = ::pclose(pipe);
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    return outcome;
  }

 private:
  TemporaryFolder folder_;
};

/// 10 × 10 pixels of mid-grey; the first `off` of them have a green brighter by `units` / 65535.
Picture grey(int off, int units) {
  Picture picture{10, 10, std::vector<float>(300, 32000.0f / 65535)};
  for (int i = 0; i < off; ++i) {
    picture.rgb[static_cast<std::size_t>(3 * i + 1)] = static_cast<float>(32000 + units) / 65535;
  }
  return picture;
}

}  // namespace

TEST_CASE("a picture compared with itself is equal, as EXR and as linear PNG") {
  const Bench bench;
  write_exr(bench / "a.exr", grey(7, 1000), {});
  write_png(bench / "a.linear.png", grey(7, 1000));
  const Outcome outcome = bench.compare("a.exr a.linear.png --tolerance 0");
  CHECK(outcome.status == 0);
  CHECK(outcome.output == "0 of 100 pixels off (0.0000 %), largest difference 0 of 65535\n");
}

TEST_CASE("pixels beyond the tolerance count as off, those within do not") {
  const Bench bench;
  write_exr(bench / "a.exr", grey(0, 0), {});
  write_exr(bench / "b.exr", grey(3, 5), {});
  CHECK(bench.compare("a.exr b.exr").status == 1);
  CHECK(bench.compare("a.exr b.exr").output ==
        "3 of 100 pixels off (3.0000 %), largest difference 5 of 65535\n");
  CHECK(bench.compare("a.exr b.exr --tolerance 5").status == 0);
  CHECK(bench.compare("a.exr b.exr --most-percent 3").status == 0);
  CHECK(bench.compare("b.exr a.exr --most-percent 2.99").status == 1);
}

TEST_CASE("8-bit pictures are compared on the scale of 16 bits") {
  const Bench bench;
  Picture other = grey(0, 0);
  other.rgb[0] = 0.497f;  // one step of 8-bit sRGB up
  write_png(bench / "a.png", grey(0, 0));
  write_png(bench / "b.png", other);
  CHECK(bench.compare("a.png b.png").output ==
        "1 of 100 pixels off (1.0000 %), largest difference 257 of 65535\n");
  CHECK(bench.compare("a.png b.png --tolerance 257").status == 0);
}

TEST_CASE("pictures of different sizes differ") {
  const Bench bench;
  write_exr(bench / "a.exr", grey(0, 0), {});
  write_exr(bench / "b.exr", {1, 1, {0, 0, 0}}, {});
  const Outcome outcome = bench.compare("a.exr b.exr --most-percent 100");
  CHECK(outcome.status == 1);
  CHECK(outcome.output == "sizes differ: 10 x 10 and 1 x 1\n");
}

TEST_CASE("the difference picture is black where pictures agree and white where they differ most") {
  const Bench bench;
  write_exr(bench / "a.exr", grey(0, 0), {});
  write_exr(bench / "b.exr", grey(1, 40), {});
  CHECK(bench.compare("a.exr b.exr --difference d.png").status == 1);
  const PngImage difference = read_png(bench / "d.png");
  CHECK(difference.rgb[0] == 0);
  CHECK(difference.rgb[1] == 255);
  CHECK(difference.rgb[4] == 0);
}

TEST_CASE("bad usage and unreadable files end with status 2 and a reason") {
  const Bench bench;
  write_exr(bench / "a.exr", grey(0, 0), {});
  const auto complaint = [&](const char* arguments, const char* reason) {
    CAPTURE(arguments);
    const Outcome outcome = bench.compare(arguments);
    CHECK(outcome.status == 2);
    CHECK_THAT(outcome.output, Catch::StartsWith(std::string("compare_pictures: ") + reason));
  };
  complaint("", "two pictures are compared");
  complaint("a.exr", "two pictures are compared");
  complaint("a.exr a.exr a.exr", "two pictures are compared");
  complaint("a.exr a.exr --tolerance", "--tolerance: no value");
  complaint("a.exr a.exr --tolerance x", "--tolerance: not a number");
  complaint("a.exr a.exr --tolerance nan", "--tolerance: not a number");
  complaint("a.exr a.exr --most-percent 101", "--most-percent: not a number");
  complaint("a.exr a.exr --sideways", "unknown option: --sideways");
  complaint("a.exr a.gif", "neither .exr nor .png: a.gif");
  complaint("a.exr b.exr", "cannot read picture: b.exr: ");
}
