// A node whose boundaries slide: which generations of the grid it holds, what it does not believe,
// and what it tells the frontal of its work.
#include <utility>

#include "catch.hpp"
#include "node/node_at_work.hpp"
#include "node/one_ball.hpp"
#include "node/parts/sliding/work_done.hpp"
#include "proto/model_slice.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// The left half of a picture of 16 × 16 pixels has the tiles 0 to 7, the right half 8 to 15.
control::Load load(BoundariesMode boundaries) {
  control::Load m = load_of({2, 1, 1, {8}, {}});
  m.tile_size = 4;
  m.boundaries = boundaries;
  return m;
}

/// A tile that is left of the boundary once that has slid to pixel 12.
constexpr std::uint32_t kSlidTile = 8;

/// Rank 0 of two nodes, whose half of space is the left one, when a picture has begun.
struct Half : NodeAtWork {
  explicit Half(BoundariesMode boundaries = BoundariesMode::kSliding)
      : NodeAtWork(*Hypercube::of_size(2), Rank{0}, load(boundaries), encode_model(one_ball())) {
    begin();
  }
  void slide(std::uint32_t generation, std::int64_t edge, SharedBytes slice = {}) {
    tell(control::Slide{1, 0, generation, {edge}, {}}, std::move(slice));
  }
  void turn(std::uint32_t current, std::uint32_t oldest) {
    tell(control::Turn{1, 0, current, oldest});
  }
  void receive(std::uint16_t generation) {
    RayTask ray = ray_into_nothing(0);
    ray.ray = {{-3, 0, 2}, {-1, 0, 0}};
    ray.generation = generation & 1;
    node.on_neighbour(encode_rays(stamp_of(Rank{1}), {&ray, 1}));
  }
  /// The messages of a type among what the node sends.
  template <typename T>
  std::vector<T> told() {
    std::vector<T> told;
    for (const Node::Outgoing& o : node.take_outgoing()) {
      batches_ += looks_like_batch(o.message.frame) && o.to;
      if (o.to || looks_like_batch(o.message.frame)) continue;
      const auto decoded = decode(o.message.text());
      if (const auto* m = std::get_if<T>(&std::get<ControlMessage>(decoded))) told.push_back(*m);
    }
    return told;
  }
  bool has_failed() { return !told<control::NodeError>().empty(); }
  std::uint64_t drops() {
    tell(control::Finish{1});
    const auto reports = told<control::NodeReport>();
    REQUIRE(reports.size() == 1);
    return reports.front().stats.malformed_drops;
  }
  /// Batches to the other node that told() has come across.
  int batches_ = 0;
};

}  // namespace

TEST_CASE("a node gets ready for the next grid beside the one that it traces in, and says so") {
  for (const bool has_slice : {false, true}) {
    Half half;
    half.slide(1, 12, has_slice ? SharedBytes(encode_model(one_ball())) : SharedBytes());
    CHECK(half.told<control::Slid>().empty());
    CHECK(half.work() == 1);
    const auto slid = half.told<control::Slid>();
    REQUIRE(slid.size() == 1);
    CHECK(slid.front().generation == 1);
    // Until the turn, tiles are those of the old grid.
    half.assign({0});
    half.turn(1, 0);
    half.assign({kSlidTile});
    CHECK(half.work() == 2);
    CHECK_FALSE(half.has_failed());
  }
}

TEST_CASE("a tile beyond the boundary is refused until that has slid") {
  Half half;
  half.slide(1, 12);
  half.work();
  half.assign({kSlidTile});
  CHECK(half.has_failed());
}

TEST_CASE("rays of a grid that isn't held, or is over, are a failure of the job") {
  Half early;
  early.receive(0);
  CHECK_FALSE(early.has_failed());
  early.receive(1);
  CHECK(early.has_failed());
  Half late;
  late.slide(1, 12);
  late.work();
  late.receive(1);
  late.turn(1, 0);
  late.receive(0);
  CHECK_FALSE(late.has_failed());
  late.turn(1, 1);
  late.receive(1);
  CHECK_FALSE(late.has_failed());
  late.receive(0);
  CHECK(late.has_failed());
}

TEST_CASE("a broken slice is an error in words") {
  Half half;
  Bytes slice = encode_model(one_ball());
  slice.resize(slice.size() / 2);
  half.slide(1, 12, slice);
  half.work();
  CHECK(half.has_failed());
}

TEST_CASE("slides and turns that make no sense are dropped, and there are never three grids") {
  Half half;
  half.slide(2, 12);
  half.slide(1, 16);
  half.slide(1, 0);
  half.tell(control::Slide{1, 0, 1, {4, 12}, {}});
  half.tell(control::Slide{1, 0, 1, {12}, {8}});
  half.turn(1, 0);
  CHECK(half.work() == 0);
  half.slide(1, 12);
  CHECK(half.work() == 1);
  half.turn(1, 0);
  // Tiles of the grid before may be open.
  half.slide(2, 4);
  CHECK(half.work() == 0);
  half.turn(1, 1);
  half.slide(2, 4);
  CHECK(half.work() == 1);
  CHECK(half.drops() == 7);
  Half fixed(BoundariesMode::kFixed);
  fixed.slide(1, 12);
  fixed.turn(0, 0);
  CHECK(fixed.work() == 0);
  CHECK(fixed.drops() == 2);
}

TEST_CASE("a node that is told that all tiles are dealt passes the token, and not before") {
  Half half;
  half.work();
  CHECK_FALSE(half.has_failed());
  CHECK(half.batches_ == 0);
  half.tell(control::Dealt{1, 0});
  CHECK_FALSE(half.has_failed());
  CHECK(half.batches_ == 1);
}

TEST_CASE("a node tells how many tiles it has begun, and how much it has done") {
  Half half;
  half.assign({0, 1, 2, 3});
  CHECK(half.work() == 4);
  const auto told = half.told<control::Worked>();
  REQUIRE(told.size() >= 2);
  CHECK(told.front().tiles == 2);
  CHECK(told.back().tiles == 4);
  CHECK(told.front().work > 0);
  CHECK(told.back().work > told.front().work);
}

TEST_CASE("work is worth telling when half of the tiles are begun, or after many rays") {
  WorkDone done(160 * WorkDone::kTellings);
  CHECK_FALSE(done.is_worth_telling(0, false));
  done.assigned(6, 6);
  CHECK_FALSE(done.is_worth_telling(4, false));
  CHECK(done.is_worth_telling(3, false));
  CHECK(done.tell(1, 0, 3).tiles == 3);
  CHECK_FALSE(done.is_worth_telling(2, false));
  CHECK(done.is_worth_telling(1, false));
  done.tell(1, 0, 1);
  done.add(10, 159);
  CHECK_FALSE(done.has_many_rays(false));
  CHECK(done.has_many_rays(true));
  done.add(2.5, 1);
  CHECK(done.has_many_rays(false));
  CHECK(done.tell(1, 0, 1).work == 12);
  CHECK_FALSE(done.has_news());
}
