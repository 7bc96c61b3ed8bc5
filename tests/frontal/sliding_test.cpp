// Boundaries that slide: when the frontal decides so, which slices it cuts anew, and what it tells
// the nodes.
#include "frontal/rendering/sliding.hpp"

#include <algorithm>

#include "catch.hpp"
#include "formats/graycube/read_scene.hpp"
#include "frontal/prepared.hpp"
#include "proto/model_slice.hpp"
#include "proto/share_of.hpp"
#include "regions/restrict.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint32_t kNodes = 4;
const Hypercube kCube = *Hypercube::of_size(kNodes);

/// A wall of 8 × 8 balls before an orthographic camera: 64 × 64 pixels, a ball for every 8 × 8.
Scene wall() {
  std::string balls;
  for (int i = 0; i < 64; ++i) {
    balls += std::string(i == 0 ? "" : ",") +
             R"({"material": "m", "csg": {"type": "sphere", "radius": 0.4, "center": [)" +
             std::to_string(i % 8 - 3.5) + "," + std::to_string(i / 8 - 3.5) + ",0]}}";
  }
  ReadResult read = read_scene_text(R"({"graycube": 1, "image": {"width": 64, "height": 64},
    "camera": {"type": "orthographic", "eye": [0,0,-9], "look_at": [0,0,0], "up": [0,1,0],
               "width": 8},
    "background": [0,0,0], "lights": [], "materials": {"m": {}}, "objects": [)" +
                                    balls + "]}");
  REQUIRE(read.scene);
  return *std::move(read.scene);
}

/// The wall, cut for four nodes, with tiles of 4 × 4 pixels.
PreparedScene sliding_scene() {
  PreparedScene scene = prepared(
      wall(), {.partition = PartitionMode::kRegular, .boundaries = BoundariesMode::kSliding},
      kNodes);
  const auto frame = CameraFrame::from(scene.settings.camera, scene.settings.image);
  scene.plan.emplace(scene.settings.image, TileShape{4, 4},
                     MacroGrid(frame, scene.grid.column_edges, scene.grid.row_edges));
  return scene;
}

/// The wall on four nodes, with boundaries that slide. Tiles have 4 × 4 pixels, 64 a node.
struct OnFour {
  PreparedScene scene = sliding_scene();
  Sliding sliding;

  explicit OnFour(const SlidingLimits& limits = {.part_between = 0})
      : sliding(1, kCube, scene, 1, limits) {}

  std::vector<std::uint32_t> tiles_of(Rank rank) const {
    std::vector<std::uint32_t> tiles;
    for (std::uint32_t tile = 0; tile < scene.plan->tile_count(); ++tile) {
      if (sliding.owners()[tile] == rank) tiles.push_back(tile);
    }
    return tiles;
  }
  /// Hands out the node's first tiles; all are begun and whole, and took that much each.
  void trace(Rank rank, std::uint32_t count, std::uint64_t cost) {
    const std::vector<std::uint32_t> tiles = tiles_of(rank);
    for (std::uint32_t i = 0; i < count; ++i) sliding.was_handed_out(tiles[i], rank);
    sliding.has_worked(rank, {1, 0, cost * count, count});
    for (std::uint32_t i = 0; i < count; ++i) sliding.is_whole(tiles[i]);
  }
  /// Traces a quarter of each node's tiles, which took rank 0 that much each, and the others 100.
  void trace_quarters(std::uint64_t cost_of_first) {
    for (std::uint32_t rank = 0; rank < kNodes; ++rank)
      trace(Rank{rank}, 16, rank == 0 ? cost_of_first : 100);
  }
  /// Gets to the end of the slide that was decided: whether there was one.
  bool slide(double began_s = 0, double ended_s = 0) {
    sliding.look(began_s);
    const auto work = sliding.take_recut();
    if (!work) return false;
    double now_s = 0;
    REQUIRE(sliding.was_recut(recut(*work, [&] { return now_s += 0.5; })));
    for (std::uint32_t rank = 0; rank < kNodes; ++rank) {
      const control::Slid slid{1, 0, sliding.generation() + 1, 0.25};
      CHECK(sliding.is_held(Rank{rank}, slid, ended_s) == (rank + 1 == kNodes));
    }
    return true;
  }
};

}  // namespace

TEST_CASE("boundaries slide when a node has more left to do than its neighbours") {
  OnFour even;
  even.trace_quarters(100);
  CHECK_FALSE(even.slide());
  OnFour uneven;
  uneven.trace_quarters(400);
  const std::size_t before = uneven.tiles_of(Rank{0}).size();
  CHECK(uneven.slide(3, 5));
  CHECK(uneven.sliding.generation() == 1);
  CHECK(uneven.tiles_of(Rank{0}).size() < before);
  const SlidingFigures& figures = uneven.sliding.figures();
  CHECK(figures.slides == 1);
  CHECK(figures.boundaries >= 1);
  CHECK(figures.slices >= 2);
  CHECK(figures.recut_s == 0.5);
  CHECK(figures.build_s == 1);
  CHECK(figures.slide_s == 2);
  CHECK(figures.generations_peak == 2);
}

TEST_CASE("the next slide waits until no tile of the boundaries before is open") {
  OnFour on;
  const std::uint32_t open = on.tiles_of(Rank{3}).back();
  on.sliding.was_handed_out(open, Rank{3});
  on.trace_quarters(400);
  REQUIRE(on.slide());
  CHECK(on.sliding.oldest() == 0);
  CHECK_FALSE(on.sliding.take_closed());
  on.sliding.has_worked(Rank{0}, {1, 0, 1'000'000, 16});
  CHECK_FALSE(on.slide());
  on.sliding.is_whole(open);
  CHECK(on.sliding.take_closed());
  CHECK_FALSE(on.sliding.take_closed());
  CHECK(on.sliding.oldest() == 1);
  CHECK(on.slide());
}

TEST_CASE("tiles that change hands keep the cost that they had where they were") {
  OnFour on;
  on.trace_quarters(900);
  int slides = 0;
  std::size_t left = 0;
  do {
    left = on.tiles_of(Rank{0}).size();
    if (on.sliding.take_closed()) ++slides;
  } while (slides < 20 && on.slide());
  // Others' tiles took a ninth here; those from there still count for nine, so it comes to rest.
  CHECK(slides < 20);
  CHECK(slides >= 2);
  CHECK(left > 20);
}

TEST_CASE("between two looks a part of the picture must have become whole") {
  OnFour on({.part_between = 0.25});
  on.trace(Rank{0}, 16, 900);
  on.trace(Rank{1}, 16, 100);
  on.trace(Rank{2}, 16, 100);
  CHECK_FALSE(on.slide());
  on.trace(Rank{3}, 16, 100);
  CHECK(on.slide());
}

TEST_CASE("a slide comes too late when all tiles have been handed out") {
  OnFour on;
  on.trace_quarters(900);
  on.sliding.look(0);
  auto work = on.sliding.take_recut();
  REQUIRE(work);
  for (std::uint32_t rank = 0; rank < kNodes; ++rank) {
    const auto tiles = on.tiles_of(Rank{rank});
    for (std::size_t i = 16; i < tiles.size(); ++i) on.sliding.was_handed_out(tiles[i], Rank{rank});
  }
  CHECK(on.sliding.all_handed_out());
  CHECK_FALSE(on.sliding.was_recut(recut(*work, [] { return 0.0; })));
  CHECK(on.sliding.figures().slides == 0);
}

TEST_CASE("a node gets few tiles ahead of those that it has begun") {
  OnFour on({.least_ahead = 4, .most_ahead = 0.25});
  CHECK(on.sliding.room_ahead(Rank{0}, 64) == 16);
  CHECK(on.sliding.room_ahead(Rank{0}, 8) == 4);
  const auto tiles = on.tiles_of(Rank{0});
  for (std::uint32_t i = 0; i < 9; ++i) on.sliding.was_handed_out(tiles[i], Rank{0});
  CHECK(on.sliding.room_ahead(Rank{0}, 64) == 0);
  on.sliding.has_worked(Rank{0}, {1, 0, 10, 1});
  CHECK(on.sliding.room_ahead(Rank{0}, 64) == 8);
}

TEST_CASE("what is cut anew is what a node of the new grid holds, and only where that changed") {
  const PreparedScene scene = sliding_scene();
  const auto frame = CameraFrame::from(scene.settings.camera, scene.settings.image);
  const MacroGrid from(frame, scene.grid.column_edges, scene.grid.row_edges);
  // A slide by 4 pixels takes half balls, one by 8 whole ones.
  for (const std::int64_t edge : {28, 24}) {
    const MacroGrid to(frame, {edge}, {32});
    const RecutResult cut = recut({1, 1, scene.model, kCube, from, to}, [] { return 0.0; });
    REQUIRE(cut.error.empty());
    REQUIRE(cut.slices.size() == kNodes);
    std::uint64_t bytes = 0, primitives = 0;
    for (std::uint32_t rank = 0; rank < kNodes; ++rank) {
      const Model now = restrict_to_share(*scene.model, to, share_of(kCube, Rank{rank}));
      const bool is_new = encode_model(now) != Bytes(scene.slices[rank].bytes().begin(),
                                                     scene.slices[rank].bytes().end());
      const auto slice = cut.slices[rank].bytes();
      CHECK(slice.empty() == !is_new);
      if (is_new) CHECK(std::ranges::equal(slice, encode_model(now)));
      bytes += slice.size();
      if (is_new) primitives += now.primitives.size();
    }
    CHECK(cut.bytes == bytes);
    CHECK(cut.primitives == primitives);
    CHECK(cut.new_primitives == 8);
  }
  const MacroGrid same(frame, {32}, {32});
  CHECK(recut({1, 1, scene.model, kCube, from, same}, [] { return 0.0; }).bytes == 0);
}

TEST_CASE("statistics say that boundaries stay where they can't slide") {
  Scene scene = wall();
  const control::JobOptions options{.boundaries = BoundariesMode::kSliding};
  CHECK(prepared(scene, options, 4).boundaries == BoundariesMode::kSliding);
  CHECK(prepared(scene, options, 1).boundaries == BoundariesMode::kFixed);
  scene.settings.image = {6, 6, 1};
  CHECK(prepared(scene, options, 4).boundaries == BoundariesMode::kFixed);
  const PreparedScene roth = prepared(wall(), options, 4, Algorithm::kRoth);
  CHECK(roth.boundaries == BoundariesMode::kFixed);
  CHECK(roth.model == nullptr);
}
