// Scenes come as text, or compiled by the client that read them: both are cut alike.
#include <algorithm>
#include <new>

#include "catch.hpp"
#include "check.hpp"
#include "csg/random_model.hpp"
#include "formats/graycube/read_scene.hpp"
#include "frontal/prepared.hpp"
#include "proto/model_slice.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

PreparationResult cut(Bytes scene, const control::JobOptions& options) {
  PreparationWork work;
  work.scene = std::move(scene);
  work.options = options;
  work.cube = *Hypercube::of_size(4);
  double seconds = 0;
  return prepare(work, [&seconds] { return seconds += 1; });
}

}  // namespace

TEST_CASE("a compiled scene is cut as its text is") {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    INFO("seed " << seed);
    const Scene scene = RandomModel(seed).scene();
    control::JobOptions options;
    options.algorithm = seed % 4 == 0 ? Algorithm::kRoth : Algorithm::kMacro;
    options.width = 64;
    options.height = 48;
    options.max_depth = 3;
    const PreparedScene text = prepared(scene, options, 4, options.algorithm);
    // The scene is read from text, as text may write a map in another way.
    const auto read = read_scene_text(write_scene_text(scene));
    REQUIRE(read.scene);
    const PreparationResult compiled = cut(encode_model(compile_scene(*read.scene)), options);
    REQUIRE(compiled.scene);
    CHECK(compiled.errors.empty());
    CHECK(compiled.scene->settings == text.settings);
    CHECK(compiled.scene->settings.image.width == 64);
    CHECK(compiled.scene->primitives == text.primitives);
    CHECK(compiled.scene->objects == text.objects);
    CHECK(compiled.scene->horizon_bytes == text.horizon_bytes);
    CHECK(compiled.scene->grid == text.grid);
    REQUIRE(compiled.scene->slices.size() == text.slices.size());
    for (std::size_t i = 0; i < text.slices.size(); ++i) {
      CHECK(std::ranges::equal(compiled.scene->slices[i].bytes(), text.slices[i].bytes()));
    }
  }
}

TEST_CASE("what reading and cutting took is told by the clock that is given") {
  const PreparationResult result = cut(encode_model(compile_scene(RandomModel(3).scene())), {});
  REQUIRE(result.scene);
  // The clock goes on by a second each time that it is read.
  CHECK(result.scene->load_s == 1);
  CHECK(result.scene->partition_s == 1);
}

TEST_CASE("a broken compiled scene is bad input, and so are options that do not fit it") {
  const Bytes whole = encode_model(compile_scene(RandomModel(3).scene()));
  Bytes broken = whole;
  broken.resize(broken.size() - 1);
  const PreparationResult short_one = cut(broken, {});
  CHECK_FALSE(short_one.scene);
  REQUIRE(short_one.errors.size() == 1);
  CHECK(short_one.errors.front().why.starts_with("the compiled scene is broken: "));
  control::JobOptions options;
  options.width = 0;
  const PreparationResult no_picture = cut(whole, options);
  CHECK_FALSE(no_picture.scene);
  REQUIRE_FALSE(no_picture.errors.empty());
  CHECK(no_picture.errors.front().where == "--size");
  CHECK_FALSE(is_encoded_model({}));
  CHECK_FALSE(is_encoded_model(std::as_bytes(std::span("{\"graycube\": 1}"))));
}

TEST_CASE("what a farm does not take is refused where it stands, whoever asked before") {
  Scene scene = RandomModel(3).scene();
  scene.settings.max_depth = kMaxCreditDepth + 1;
  scene.settings.lights.resize(kMaxCreditLights + 1);
  const PreparationResult deep = cut(encode_model(compile_scene(scene)), {});
  REQUIRE(deep.errors.size() == 2);
  CHECK(deep.errors[0] ==
        control::ErrorItem{"/max_depth", "roth and macro take at most 120; use serial"});
  CHECK(deep.errors[1] ==
        control::ErrorItem{"/lights", "roth and macro take at most 64 lights; use serial"});
}

TEST_CASE(
    "a check that fails, or an exception, while a scene is prepared is an error of that job") {
  PreparationWork work;
  work.job = 7;
  work.scene_name = "plate.json";
  const auto failure_of = [&](const std::function<double()>& clock_s) {
    const PreparationResult result = prepare(work, clock_s);
    CHECK(result.job == 7);
    CHECK_FALSE(result.scene);
    CHECK(result.is_internal);
    REQUIRE(result.errors.size() == 1);
    CHECK(result.errors.front().where == "plate.json");
    return result.errors.front().why;
  };
  const std::string check = failure_of([]() -> double {
    GRAYCUBE_CHECK(1 + 1 == 3, "the clock shows %d", 13);
    return 0;
  });
  CHECK(check.starts_with("internal error: "));
  CHECK(check.ends_with("1 + 1 == 3: the clock shows 13"));
  CHECK(failure_of([]() -> double { throw std::bad_alloc(); }) ==
        "there is not enough memory to prepare it");
}

TEST_CASE("solids that can't be computed are the scene's errors, each with its pointer") {
  Scene scene = RandomModel(3).scene();
  scene.objects.assign(2, {"", 0, node_of(SphereShape{{0, 0, 1e30}, 1})});
  const std::string text = write_scene_text(scene);
  const auto* bytes = reinterpret_cast<const std::byte*>(text.data());
  const PreparationResult result = cut(Bytes(bytes, bytes + text.size()), {});
  CHECK_FALSE(result.scene);
  CHECK_FALSE(result.is_internal);
  REQUIRE(result.errors.size() == 2);
  CHECK(result.errors.back().where == "/objects/1/csg");
}
