// Pictures against POV-Ray's of the same scenes, as 16-bit linear samples.
#include <sys/wait.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "catch.hpp"
#include "film/picture_files.hpp"
#include "film/transfer.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/pov/write_pov.hpp"
#include "process/temporary_folder.hpp"
#include "scene/compile_scene.hpp"
#include "trace/render_serial.hpp"

using namespace graycube;
namespace fs = std::filesystem;

namespace {

constexpr std::uint32_t kSide = 128;
/// The difference, in 1/65535, that two renderers may have by rounding alone.
constexpr int kTolerance = 4;

int run(const std::string& command) {
  const int status = std::system(command.c_str());  // NOLINT(cert-env33-c,concurrency-mt-unsafe)
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

struct Golden {
  std::string scene;
  /// Objects that are left out, because POV-Ray treats them differently.
  std::vector<std::string> without;
  double most_percent;
};

/// POV-Ray nests transparent solids that overlap, takes either of two faces that coincide, and lets
/// shadow rays skip what is nearer than 0.001.
std::vector<Golden> golden_scenes() {
  return {{"first", {}, 0.05},
          {"mirrors", {}, 0.05},
          {"tori", {}, 0.05},
          {"ortho", {"pool"}, 0.05},  // its bottom is its basin's
          {"sponge", {}, 0.05},
          {"tetrahedra", {}, 0.05},
          {"tree", {}, 0.05},
          {"vase", {}, 0.2},
          // The lenses and the prism reach into their neighbours.
          {"glass", {"biconvex lens", "biconcave lens", "prism"}, 0.2}};
}

Scene load(const std::string& name, const std::vector<std::string>& without) {
  const ReadResult result = read_scene_file(fs::path(GRAYCUBE_SCENES) / (name + ".json"));
  for (const SceneError& e : result.errors) UNSCOPED_INFO(e.pointer << ": " << e.message);
  REQUIRE(result.scene);
  Scene scene = *result.scene;
  scene.settings.image = {kSide, kSide, 1};
  std::erase_if(scene.objects, [&](const SceneObject& o) {
    return std::find(without.begin(), without.end(), o.name) != without.end();
  });
  return scene;
}

/// Runs the command that the written scene's own first line gives.
PngImage povray_picture(const Scene& scene) {
  const PovScene pov = write_pov(scene);
  for (const std::string& warning : pov.warnings) UNSCOPED_INFO(warning);
  REQUIRE(pov.warnings.empty());
  const std::string prefix = "// povray +INAME.pov +ONAME.png ";
  const std::string first_line = pov.text.substr(0, pov.text.find('\n'));
  REQUIRE(first_line.substr(0, prefix.size()) == prefix);
  const TemporaryFolder folder;
  std::ofstream(folder.path() / "scene.pov") << pov.text;
  const std::string command = "cd " + folder.path().string() +
                              " && povray +Iscene.pov +Oscene.png " +
                              first_line.substr(prefix.size()) + " +WT1 >povray.log 2>&1";
  if (run(command) != 0) {
    std::ostringstream log;
    log << std::ifstream(folder.path() / "povray.log").rdbuf();
    FAIL("povray failed: " << command << "\n" << log.str());
  }
  return read_png(folder.path() / "scene.png");
}

Picture our_picture(const Scene& scene) {
  const Domain domain(compile_scene(scene));
  Film film(kSide, kSide, 1);
  render_serial(domain, {}, film);
  return film.develop();
}

/// Checks that at most so many percent of pixels differ by more than the tolerance in a channel.
void compare(const Scene& scene, double most_percent) {
  const PngImage theirs = povray_picture(scene);
  const Picture ours = our_picture(scene);
  REQUIRE(theirs.bits == 16);
  REQUIRE(theirs.width == kSide);
  REQUIRE(theirs.height == kSide);
  std::size_t off = 0;
  int largest = 0, brightest = 0;
  for (std::size_t pixel = 0; pixel < std::size_t{kSide} * kSide; ++pixel) {
    int worst = 0;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
      worst = std::max(worst, std::abs(int{linear_16_bit(ours.rgb[i])} - int{theirs.rgb[i]}));
      brightest = std::max(brightest, int{theirs.rgb[i]});
    }
    off += worst > kTolerance ? 1 : 0;
    largest = std::max(largest, worst);
  }
  const double percent = 100.0 * static_cast<double>(off) / (kSide * kSide);
  INFO(off << " pixels off (" << percent << " %), largest difference " << largest);
  CHECK(percent <= most_percent);
  CHECK(brightest > 20000);
}

}  // namespace

TEST_CASE("POV-Ray renders the same pictures") {
  if (run("povray --version >/dev/null 2>&1") != 0) {
    WARN("povray is not installed: NOT compared with it");
    return;
  }
  const Golden golden = GENERATE(from_range(golden_scenes()));
  INFO(golden.scene);
  compare(load(golden.scene, golden.without), golden.most_percent);
}
