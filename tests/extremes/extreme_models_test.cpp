// Models of other programs with extreme numbers: their importers refuse them with a reason, or make
// scenes that are refused or rendered alike by all. GRAYCUBE_SEEDS=N tries N of each format,
// GRAYCUBE_SEED=S only that one.
#include <cstdint>
#include <functional>
#include <map>
#include <optional>

#include "catch.hpp"
#include "extremes/extreme_model.hpp"
#include "extremes/extreme_trial.hpp"
#include "formats/brlcad/brlcad.hpp"
#include "formats/mesh/close_parts.hpp"
#include "formats/mesh/off.hpp"
#include "formats/mesh/stl.hpp"
#include "formats/openscad/openscad.hpp"
#include "formats/view/mesh_scene.hpp"
#include "simulation/random_trial.hpp"

using namespace graycube;
using namespace graycube::testing;
using simulation::number_in_environment;

namespace {

constexpr std::uint64_t kSeeds = 200;
constexpr ImageSize kImage{12, 8, 1};

using Import = std::function<std::optional<Scene>(std::uint64_t seed)>;

Frame frame() {
  Frame frame;
  frame.image = kImage;
  return frame;
}

std::optional<Scene> scene_of_csg(std::uint64_t seed) {
  OpenscadOptions options;
  options.frame = frame();
  // With facets minkowski() needs the program.
  options.facets = seed % 4 == 0;
  const OpenscadResult result = read_openscad_csg(ExtremeModel(seed).csg(), options);
  CHECK(result.scene.has_value() == result.errors.empty());
  return result.scene;
}

std::optional<Scene> scene_of_asc(std::uint64_t seed) {
  BrlcadOptions options;
  options.image = kImage;
  const BrlcadResult result = read_brlcad(ExtremeModel(seed).asc(), options);
  CHECK(result.scene.has_value() == result.errors.empty());
  return result.scene;
}

std::optional<Scene> scene_of_closed(const PolygonMesh& polygons) {
  auto closed = closed_mesh(polygons);
  if (const auto* fault = std::get_if<MeshFault>(&closed)) {
    CHECK_FALSE(fault->why.empty());
    return std::nullopt;
  }
  return scene_of_mesh({std::get<TriangleMesh>(std::move(closed)), polygons.digits}, frame());
}

std::optional<Scene> scene_of_off(std::uint64_t seed) {
  const auto read = read_off(ExtremeModel(seed).off());
  const auto* polygons = std::get_if<PolygonMesh>(&read);
  return polygons != nullptr ? scene_of_closed(*polygons) : std::nullopt;
}

std::optional<Scene> scene_of_stl(std::uint64_t seed) {
  ExtremeModel model(seed);
  auto read = read_stl(seed % 2 == 0 ? model.ascii_stl() : model.binary_stl());
  auto* parts = std::get_if<std::vector<MeshPart>>(&read);
  if (parts == nullptr) return std::nullopt;
  auto closed = closed_body(std::move(*parts), OpenMeshes::kLeaveOut);
  auto* body = std::get_if<MeshSolids>(&closed);
  if (body == nullptr || body->solids.empty()) return std::nullopt;
  return scene_of_mesh(std::move(body->solids.front().shape), frame());
}

/// The scene as a farm gets it; nothing if its numbers, such as the camera's, are too large.
std::optional<std::string> text_of(const Scene& scene) {
  try {
    return write_scene_text(scene);
  } catch (const UnrenderableScene& e) {
    CHECK_FALSE(e.faults().empty());
    return std::nullopt;
  }
}

/// Tries the seeds, of which a share must come to each end for that to mean something.
void try_seeds(const Import& imported, std::uint64_t most_refused) {
  const std::uint64_t only = number_in_environment("GRAYCUBE_SEED", 0);
  const std::uint64_t last = only != 0 ? only : number_in_environment("GRAYCUBE_SEEDS", kSeeds);
  std::uint64_t refused = 0;
  std::map<ExtremeEnd, std::uint64_t> ends;
  for (std::uint64_t seed = only != 0 ? only : 1; seed <= last; ++seed) {
    INFO("seed " << seed);
    const std::optional<Scene> scene = imported(seed);
    const auto text = scene ? text_of(*scene) : std::nullopt;
    if (text) {
      ++ends[try_extreme(seed, *text)];
    } else {
      ++refused;
    }
  }
  if (only != 0 || last < kSeeds) return;
  UNSCOPED_INFO("refused " << refused << ", pictures " << ends[ExtremeEnd::kPicture]);
  CHECK(refused <= most_refused * last / 100);
  CHECK(ends[ExtremeEnd::kPicture] > last / 5);
}

}  // namespace

TEST_CASE(".csg models of extreme numbers are left out, refused, or rendered alike by all") {
  try_seeds(scene_of_csg, 40);
}
TEST_CASE(".asc databases of extreme numbers are left out, refused, or rendered alike by all") {
  try_seeds(scene_of_asc, 60);
}
TEST_CASE(".off meshes of extreme numbers are refused, or rendered alike by all") {
  try_seeds(scene_of_off, 60);
}
TEST_CASE(".stl meshes of extreme numbers are refused, or rendered alike by all") {
  try_seeds(scene_of_stl, 60);
}
