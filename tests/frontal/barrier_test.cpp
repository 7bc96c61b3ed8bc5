#include "frontal/rendering/barrier.hpp"

#include "catch.hpp"
#include "frontal/rendering/standstill_watch.hpp"

using namespace graycube;

namespace {

constexpr Rank kFirst{0}, kSecond{1};

void load_both(Barrier& barrier) {
  barrier.was_loaded(kFirst);
  barrier.was_loaded(kSecond);
}

}  // namespace

TEST_CASE("nodes may trace once all have built, and in a later epoch acknowledged") {
  Barrier barrier(2, true);
  CHECK(barrier.needs_load());
  load_both(barrier);
  CHECK_FALSE(barrier.needs_load());
  barrier.is_ready(kFirst, 0);
  CHECK_FALSE(barrier.is_open());
  barrier.is_ready(kSecond, 0);
  CHECK(barrier.is_open());
  barrier.begin(1);
  CHECK_FALSE(barrier.can_trace(kFirst));
  barrier.has_acknowledged(kFirst, 1);
  barrier.has_acknowledged(kSecond, 0);
  CHECK_FALSE(barrier.is_open());
  barrier.has_acknowledged(kSecond, 1);
  CHECK(barrier.is_open());
}

TEST_CASE("a slice that was built for the epoch before is as good; a lost node has none") {
  Barrier barrier(2, true);
  load_both(barrier);
  barrier.is_ready(kFirst, 0);
  barrier.lose(kFirst);
  barrier.begin(1);
  CHECK(barrier.needs_load(kFirst));
  CHECK_FALSE(barrier.needs_load(kSecond));
  // The other one was still building when the epoch began.
  barrier.has_acknowledged(kSecond, 1);
  barrier.is_ready(kSecond, 0);
  CHECK(barrier.can_trace(kSecond));
  CHECK_FALSE(barrier.is_open());
  barrier.was_loaded(kFirst);
  barrier.is_ready(kFirst, 1);
  CHECK(barrier.is_open());
}

TEST_CASE("where all are loaded anew, what was built before doesn't count") {
  Barrier barrier(2, true);
  load_both(barrier);
  barrier.begin(1);
  barrier.load_all();
  CHECK(barrier.needs_load());
  load_both(barrier);
  barrier.is_ready(kFirst, 0);
  // Where slices go from node to node, nodes acknowledge that they were loaded.
  barrier.has_acknowledged(kFirst, 1);
  barrier.is_ready(kSecond, 1);
  CHECK_FALSE(barrier.is_open());
  barrier.is_ready(kFirst, 1);
  CHECK(barrier.is_open());
}

TEST_CASE("nodes that need no others go on, and one that takes a lost one's place joins them") {
  Barrier barrier(2, false);
  load_both(barrier);
  barrier.is_ready(kFirst, 0);
  CHECK_FALSE(barrier.is_open());
  barrier.is_ready(kSecond, 0);
  barrier.lose(kFirst);
  barrier.begin(1);
  CHECK_FALSE(barrier.is_open());
  barrier.has_acknowledged(kSecond, 1);
  CHECK(barrier.is_open());
  CHECK_FALSE(barrier.can_trace(kFirst));
}

TEST_CASE("a node that works without getting on is told from one that waits") {
  StandstillWatch watch(2);
  watch.begin();
  watch.on_pong(kFirst, {1, 5, 2}, 10);
  watch.on_pong(kSecond, {1, 7, 0}, 10);
  CHECK_FALSE(watch.standing_still(19, 10));
  CHECK(watch.standing_still(21, 10) == kFirst);
  watch.on_pong(kFirst, {2, 6, 2}, 21);
  CHECK_FALSE(watch.standing_still(30, 10));
  // Nobody works any more, and nothing comes.
  watch.on_pong(kFirst, {3, 6, 0}, 30);
  CHECK_FALSE(watch.all_wait(34, 5));
  CHECK(watch.all_wait(36, 5));
  watch.begin();
  CHECK_FALSE(watch.all_wait(36, 5));
}
