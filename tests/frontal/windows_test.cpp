// How many tiles a node may have open at a time.

#include "catch.hpp"
#include "frontal/prepared.hpp"
#include "frontal/rendering/render_job.hpp"
#include "trace/corner_scene.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kNodes = 2, kThreads = 3;

RenderJob roth_job(Grain grain, std::uint32_t side) {
  Scene scene = corner_scene();
  scene.settings.image = {side, side, 1};
  PreparedScene cut = prepared(scene, {.grain = grain}, kNodes, Algorithm::kRoth);
  return RenderJob(1, std::move(cut), *Hypercube::of_size(kNodes), kThreads);
}

}  // namespace

TEST_CASE("roth hands out many tiles while many are left, and few towards the end") {
  RenderJob many = roth_job(Grain::kTile, 1024);
  CHECK(many.next_tiles(Rank{0}).size() == kMostRothTilesPerThread * kThreads);
  CHECK(many.next_tiles(Rank{0}).empty());
  CHECK(many.next_tiles(Rank{1}).size() == kMostRothTilesPerThread * kThreads);
  // 256 tiles: 27 are 3 · ⌊(256 − 27) / (4 · 2 · 3)⌋.
  RenderJob some = roth_job(Grain::kTile, 256);
  CHECK(some.next_tiles(Rank{0}).size() == 27);
  RenderJob few = roth_job(Grain::kTile, 64);
  CHECK(few.tiles() == 16);
  CHECK(few.next_tiles(Rank{0}).size() == kRothTilesPerThread * kThreads);
}

TEST_CASE("in macro tiles are handed out again when a quarter of the window is free") {
  Scene scene = corner_scene();
  scene.settings.image = {512, 512, 1};
  RenderJob job(1, prepared(scene, {.partition = PartitionMode::kRegular}, kNodes),
                *Hypercube::of_size(kNodes), 1, {.window_tiles = 16});
  const std::vector<std::uint32_t> first = job.next_tiles(Rank{0});
  REQUIRE(first.size() == 16);
  std::uint64_t sequence = 0;
  const auto make_whole = [&](std::uint32_t tile) {
    const BatchStamp stamp{job.id(), job.epoch(), 0, 0, sequence++};
    const std::uint64_t units = kTileSide * kTileSide;
    std::vector<Rank> opened;
    const Bytes batch =
        encode_contributions(stamp, {{{tile, Credit::from_words({units, 0, 0, 0, 0})}}}, {});
    REQUIRE(job.add_contributions(batch, opened).wrong.empty());
    REQUIRE(opened == std::vector<Rank>{Rank{0}});
  };
  for (std::size_t i = 0; i < 3; ++i) {
    make_whole(first[i]);
    CHECK(job.next_tiles(Rank{0}).empty());
  }
  make_whole(first[3]);
  CHECK(job.next_tiles(Rank{0}).size() == 4);
}

TEST_CASE("in macro windows shrink where many rays descend from a pixel") {
  const auto job = [](Scene scene, FlowLimits limits) {
    scene.settings.image = {1024, 1024, 1};
    return RenderJob(1, prepared(scene, {}, kNodes), *Hypercube::of_size(kNodes), 1, limits);
  };
  const Scene plain = corner_scene();
  RenderJob open = job(plain, {});
  CHECK(open.next_tiles(Rank{0}).size() == FlowLimits{}.window_tiles);
  CHECK(open.load().window_tiles == FlowLimits{}.window_tiles);
  // A third of the rays that 64 such tiles may bring: each has 256 primary rays, and each of these
  // brings more than one ray in all.
  RenderJob narrow = job(plain, {.window_rays = 64 * 256 / 3.0});
  const std::size_t fewer = narrow.next_tiles(Rank{0}).size();
  CHECK(fewer < 64 / 3);
  CHECK(fewer > FlowLimits{}.least_window_tiles);
  CHECK(narrow.load().window_tiles == fewer);
  CHECK(job(plain, {.window_rays = 1}).next_tiles(Rank{0}).size() ==
        FlowLimits{}.least_window_tiles);
  CHECK(job(plain, {.window_tiles = 3, .window_rays = 1}).next_tiles(Rank{0}).size() == 3);
}

TEST_CASE("roth hands out pixels and lines as in 1987") {
  for (const Grain grain : {Grain::kPixel, Grain::kLine}) {
    RenderJob job = roth_job(grain, 1024);
    CHECK(job.next_tiles(Rank{0}).size() == kRothTilesPerThread * kThreads);
  }
}
