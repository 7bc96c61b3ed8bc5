#include "node/work_queue.hpp"

#include "catch.hpp"
#include "node/sent_mail.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// 16 tiles of 4 × 4 pixels.
const TilePlan kPlan(ImageSize{16, 16, 1}, TileShape{4, 4});

struct Queue {
  WorkQueue queue;
  /// The number of rays whose credit became free, indexed by link.
  std::vector<std::size_t> free{0, 0};
  Pace pace;

  explicit Queue(std::uint64_t own_tiles = 0, bool is_one_by_one = false)
      : queue(own_tiles, is_one_by_one) {
    pace.is_one_by_one = is_one_by_one;
    if (is_one_by_one) pace.most_rays = 1;
  }
  std::optional<WorkQueue::Piece> take(bool may_start_tiles = true) {
    return queue.take(pace, may_start_tiles, kPlan,
                      [this](std::uint32_t bit, std::size_t rays) { free[bit] += rays; });
  }
  std::size_t rays_taken() { return std::get<RayWork>(take().value().what).rays.size(); }
};

}  // namespace

TEST_CASE("own rays come before received ones, those before a neighbour's, and all before tiles") {
  Queue q;
  q.queue.add_tiles(std::vector<std::uint32_t>{7});
  q.queue.add_helped(Rank{2}, 1, shadow_rays(4));
  q.queue.add_received(shadow_rays(3), 0);
  q.queue.add_own(shadow_rays(2));
  CHECK(q.queue.held() == 7);
  CHECK(q.rays_taken() == 2);
  CHECK(q.free == std::vector<std::size_t>{0, 0});
  const auto received = q.take();
  REQUIRE(received);
  CHECK(received->is_received);
  CHECK(q.free == std::vector<std::size_t>{3, 0});
  const auto helped = q.take();
  REQUIRE(helped);
  CHECK(helped->helped == Rank{2});
  CHECK(q.free == std::vector<std::size_t>{3, 4});
  CHECK(std::get<TileWork>(q.take().value().what).tile == 7);
  CHECK_FALSE(q.take());
  CHECK(q.queue.is_empty());
}

TEST_CASE("tiles wait while none may be started") {
  Queue q;
  q.queue.add_tiles(std::vector<std::uint32_t>{1, 2});
  CHECK_FALSE(q.take(false));
  CHECK(q.queue.has_tiles());
  CHECK(q.take(true));
}

TEST_CASE("where rays go one by one a tile is handed out pixel by pixel, row by row") {
  Queue q(0, true);
  q.queue.add_tiles(std::vector<std::uint32_t>{5});
  for (std::uint32_t i = 0; i < 16; ++i) {
    CHECK(q.queue.has_tiles());
    const TileWork work = std::get<TileWork>(q.take().value().what);
    CHECK(work.tile == 5);
    CHECK(work.rect.x0 == 4 + i % 4);
    CHECK(work.rect.y0 == 4 + i / 4);
    CHECK(work.rect.x1 == work.rect.x0 + 1);
  }
  CHECK(q.queue.is_empty());
}

TEST_CASE("what was set aside for a neighbour comes first, and takes up no credit") {
  Queue q;
  q.queue.add_helped(Rank{2}, 1, shadow_rays(4));
  q.queue.add_helped_again(Rank{1}, shadow_rays(5));
  CHECK(q.queue.held() == 4);
  const auto first = q.take();
  REQUIRE(first);
  CHECK(first->helped == Rank{1});
  CHECK(q.free == std::vector<std::size_t>{0, 0});
}

TEST_CASE("tiles are given from the end, as far as they are own ones") {
  Queue q;
  q.queue.add_tiles(std::vector<std::uint32_t>{0, 1, 2, 13, 14, 15});
  const auto is_own = [](std::uint32_t tile) { return tile >= 10; };
  CHECK(q.queue.own_tiles_at_end(16, is_own) == 3);
  CHECK(q.queue.own_tiles_at_end(2, is_own) == 2);
  CHECK(q.queue.give_tiles(2) == std::vector<std::uint32_t>{15, 14});
  CHECK(q.queue.tiles() == 4);
}

TEST_CASE(
    "a node is not done before the frontal has handed out all its tiles, or others have traced "
    "them") {
  Queue q(3);
  CHECK_FALSE(q.queue.is_empty());
  q.queue.expect_less(2);
  CHECK(q.queue.unassigned() == 1);
  q.queue.expect_less(2);
  CHECK(q.queue.is_empty());
  q.queue.reset();
  CHECK(q.queue.unassigned() == 3);
}

TEST_CASE("models are taken in the order in which they came") {
  Queue q;
  q.queue.add_model(BorrowWork{Rank{3}, {}});
  q.queue.add_model(CopyWork{Rank{1}, {}, {}, 0});
  CHECK(std::get<BorrowWork>(q.queue.take_model().value()).from == Rank{3});
  CHECK(std::get<CopyWork>(q.queue.take_model().value()).from == Rank{1});
  CHECK_FALSE(q.queue.take_model());
}
