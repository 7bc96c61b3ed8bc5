// The partitions that are picked when a command leaves the macro-regions' boundaries open.
#include <algorithm>
#include <map>
#include <set>

#include "catch.hpp"
#include "frontal/prepared.hpp"
#include "scene/compile_scene.hpp"
#include "trace/corner_scene.hpp"
#include "trace/domain.hpp"

using namespace graycube;
using namespace graycube::testing;

TEST_CASE("boundaries are placed by the work where nothing is asked for") {
  const PreparedScene open = prepared(corner_scene(), {});
  CHECK(open.partition == PartitionMode::kBalanced);
  const PreparedScene balanced = prepared(corner_scene(), {.partition = PartitionMode::kBalanced});
  const PreparedScene regular = prepared(corner_scene(), {.partition = PartitionMode::kRegular});
  CHECK(open.grid == balanced.grid);
  CHECK_FALSE(open.grid == regular.grid);
  CHECK(regular.partition == PartitionMode::kRegular);
  CHECK(choices_text(open) == "scatter 1, horizon shadows, balanced partition, neighbours help");
  CHECK(choices_text(balanced) == "scatter 1, horizon shadows, balanced partition");
}

TEST_CASE(
    "where work lies where pixels are, each row of nodes has its own cuts, and as much to do as "
    "the others") {
  Scene scene = corner_scene();
  for (int i = 0; i < 6; ++i) scene.settings.lights.push_back(scene.settings.lights.front());
  const PreparedScene open = prepared(scene, {}, 16);
  REQUIRE(open.grid.own_edges.size() == 12);
  CHECK(std::set<std::int64_t>(open.grid.own_edges.begin(), open.grid.own_edges.end()).size() > 3);
  // Work of each node; a pixel that sees the ball sends out rays to eight lights.
  const Domain whole(compile_scene(scene));
  CrossingScratch scratch;
  const auto busiest = [&](const PreparedScene& cut) {
    std::map<std::uint32_t, std::uint32_t> work;
    std::uint32_t most = 0, all = 0;
    for (std::uint32_t pixel = 0; pixel < 128 * 96; ++pixel) {
      const bool hits =
          whole
              .first_crossing(whole.frame().primary_ray(pixel % 128, pixel / 128, 0, 0), 0, 1e9,
                              scratch)
              .has_value();
      const RegionIndex owner = cut.plan->owner_of_tile(cut.plan->tile_of_pixel(pixel));
      all += hits ? 9 : 1;
      most = std::max(most, work[owner.row * 4u + owner.column] += hits ? 9 : 1);
    }
    return 16.0 * most / all;
  };
  CHECK(busiest(open) < 1.5);
  CHECK(busiest(prepared(scene, {.partition = PartitionMode::kRegular}, 16)) > 2);
  // Nodes know nothing of rays that begin beside their regions, or pixels' rays lie on boundaries:
  // then own pixels are the region's.
  CHECK(prepared(scene, {.partition = PartitionMode::kRegular}, 16).grid.own_edges.empty());
  CHECK(prepared(scene, {.shadows = ShadowMode::kForward}, 16).grid.own_edges.empty());
  CHECK(prepared(scene, {.shadows = ShadowMode::kLocal}, 16).grid.own_edges.empty());
  CHECK(prepared(scene, {.scatter = 2}, 16).grid.own_edges.empty());
}

TEST_CASE(
    "own pixels of a row's nodes follow each other, however small the picture and however uneven "
    "the work") {
  std::size_t beside = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    INFO("seed " << seed);
    Dice dice(seed);
    Scene scene = corner_scene();
    scene.settings.image = {static_cast<std::uint32_t>(64 + dice.below(20)),
                            static_cast<std::uint32_t>(64 + dice.below(20)), 1};
    scene.settings.camera.look_at = {dice.between(-4, 4), dice.between(-4, 4), 0};
    for (int i = 0; i < 30; ++i) scene.settings.lights.push_back(scene.settings.lights.front());
    const PreparedScene cut = prepared(scene, {}, 16);
    REQUIRE(cut.grid.own_edges.size() == 12);
    for (std::size_t i = 0; i < 12; ++i) {
      const std::int64_t before = i % 3 == 0 ? 0 : cut.grid.own_edges[i - 1];
      REQUIRE(cut.grid.own_edges[i] > before);
      REQUIRE(cut.grid.own_edges[i] < scene.settings.image.width);
      beside += cut.grid.own_edges[i] != cut.grid.column_edges[i % 3] ? 1 : 0;
    }
  }
  CHECK(beside > 100);
}

TEST_CASE("no pre-render is made where it would not pay") {
  SECTION("a picture with fewer primary rays than the scene has work for") {
    Scene scene = corner_scene();
    scene.settings.image = {32, 32, 1};
    CHECK(prepared(scene, {}).partition == PartitionMode::kBalanced);
    for (int i = 0; i < 600; ++i) scene.objects.push_back(scene.objects.front());
    CHECK(prepared(scene, {}).partition == PartitionMode::kRegular);
    CHECK(prepared(scene, {.partition = PartitionMode::kBalanced}).partition ==
          PartitionMode::kBalanced);
  }
  SECTION("a picture too small for its cells, even where it is asked for") {
    Scene scene = corner_scene();
    scene.settings.image = {8, 8, 1};
    CHECK(prepared(scene, {.partition = PartitionMode::kBalanced}).partition ==
          PartitionMode::kRegular);
  }
  SECTION("one node") {
    CHECK(prepared(corner_scene(), {}, 1).partition == PartitionMode::kRegular);
  }
  SECTION("nodes that hold the whole scene and help each other") {
    const PreparedScene local = prepared(corner_scene(), {.shadows = ShadowMode::kLocal});
    CHECK(local.has_replicas);
    CHECK(local.slices.size() == 1);
    CHECK_FALSE(local.makes_copies);
    CHECK(local.partition == PartitionMode::kRegular);
  }
  SECTION("the queues of 1987") {
    CHECK(prepared(corner_scene(), {.flow = FlowMode::kBlocking}).partition ==
          PartitionMode::kRegular);
  }
}
