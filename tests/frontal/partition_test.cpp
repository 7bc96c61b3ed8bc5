// What is picked where a command leaves the macro-regions' boundaries open.
#include <catch2/catch.hpp>

#include "frontal/prepared.hpp"
#include "trace/corner_scene.hpp"

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

TEST_CASE("no pre-render is made where it would not pay") {
  SECTION("a picture with fewer primary rays than the scene has work for") {
    Scene scene = corner_scene();
    scene.settings.image = {32, 32, 1};
    CHECK(prepared(scene, {}).partition == PartitionMode::kBalanced);
    for (int i = 0; i < 600; ++i) scene.objects.push_back(scene.objects.front());
    CHECK(prepared(scene, {}).partition == PartitionMode::kRegular);
    CHECK(prepared(scene, {.partition = PartitionMode::kBalanced}).partition == PartitionMode::kBalanced);
  }
  SECTION("a picture too small for its cells, even where it is asked for") {
    Scene scene = corner_scene();
    scene.settings.image = {8, 8, 1};
    CHECK(prepared(scene, {.partition = PartitionMode::kBalanced}).partition == PartitionMode::kRegular);
  }
  SECTION("one node") { CHECK(prepared(corner_scene(), {}, 1).partition == PartitionMode::kRegular); }
  SECTION("nodes that hold the whole scene and help each other") {
    const PreparedScene local = prepared(corner_scene(), {.shadows = ShadowMode::kLocal});
    CHECK(local.has_replicas);
    CHECK(local.slices.size() == 1);
    CHECK_FALSE(local.makes_copies);
    CHECK(local.partition == PartitionMode::kRegular);
  }
  SECTION("the queues of 1987") {
    CHECK(prepared(corner_scene(), {.flow = FlowMode::kBlocking}).partition == PartitionMode::kRegular);
  }
}
