// The generated scenes are valid, repeatable, and of the size that was asked for.
#include "bench/scene_families.hpp"

#include <algorithm>
#include <string>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "formats/graycube/write_scene.hpp"
#include "scene/compile_scene.hpp"

using namespace graycube;
using namespace graycube::bench;

namespace {

/// A small scene of each family.
std::uint32_t small_size(Family family) {
  switch (family) {
    case Family::kCsg: return 100;
    case Family::kSpheres: return 50;
    case Family::kFlake: return 2;
    case Family::kMenger: return 2;
    case Family::kDeepCsg: return 40;
    case Family::kGlassLens: return 9;
  }
  return 0;
}

std::size_t primitives(Family family, std::uint32_t size) {
  return compile_scene(make_scene(family, size, 11)).primitives.size();
}

}  // namespace

TEST_CASE("every family's scenes are what the scene reader accepts, to the last digit") {
  for (const FamilyInfo& info : families()) {
    CAPTURE(std::string(info.name));
    const Scene scene = make_scene(info.family, small_size(info.family), 11);
    const ReadResult read = read_scene_text(write_scene_text(scene));
    for (const SceneError& e : read.errors) UNSCOPED_INFO(e.pointer << ": " << e.message);
    REQUIRE(read.scene.has_value());
    CHECK(*read.scene == scene);
  }
}

TEST_CASE("a seed gives the same scene again, another seed another scene") {
  for (const FamilyInfo& info : families()) {
    CAPTURE(std::string(info.name));
    const std::uint32_t size = small_size(info.family);
    CHECK(make_scene(info.family, size, 11) == make_scene(info.family, size, 11));
    CHECK_FALSE(make_scene(info.family, size, 11) == make_scene(info.family, size, 12));
  }
}

TEST_CASE("sizes mean what they say") {
  CHECK(primitives(Family::kCsg, 1000) == 1000);
  CHECK(primitives(Family::kCsg, 10'000) == 10'000);
  CHECK(primitives(Family::kSpheres, 1000) == 1000 + 1);
  CHECK(primitives(Family::kFlake, 5) == 66'430 + 1);
  CHECK(primitives(Family::kMenger, 3) == 1 + 1263 + 1);
  CHECK(primitives(Family::kDeepCsg, 2000) == 1 + 2000 + 1 + 1);
  CHECK(make_scene(Family::kGlassLens, 9, 11).settings.max_depth == 9);
}

TEST_CASE("one in five solids of a field is a mirror") {
  const Scene scene = make_scene(Family::kCsg, 10'000, 11);
  const auto mirrors = std::count_if(
      scene.objects.begin(), scene.objects.end(),
      [&](const auto& o) { return scene.materials[o.material].material.reflect > 0; });
  CHECK(mirrors > 3333 * 17 / 100);
  CHECK(mirrors < 3333 * 23 / 100);
}

TEST_CASE("families are found by name") {
  for (const FamilyInfo& info : families()) CHECK(family_of(info.name) == info.family);
  CHECK(family_of("teapots") == std::nullopt);
}
