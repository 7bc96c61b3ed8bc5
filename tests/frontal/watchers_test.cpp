#include "frontal/parts/watchers.hpp"

#include "catch.hpp"
#include "frontal/sent_post.hpp"

using namespace graycube;
using namespace graycube::testing;

TEST_CASE("those who watch a job hear of it, once each, and others don't") {
  Post post(1);
  Watchers watchers;
  watchers.add(1, "a");
  watchers.add(1, "b");
  watchers.add(1, "a");
  watchers.add(2, "c");
  watchers.tell({.job = 1}, 5, post);
  CHECK(SentPost(post).names() == std::vector<std::string>{"a: progress", "b: progress"});
  watchers.tell({.job = 3}, 5, post);
  CHECK(SentPost(post).all.empty());
}

TEST_CASE("whoever has been told of a job's end watches it no longer") {
  Post post(1);
  Watchers watchers;
  watchers.add(1, "a");
  CHECK(watchers.take(1) == std::set<PeerId>{"a"});
  CHECK(watchers.take(1).empty());
  watchers.tell({.job = 1}, 5, post);
  CHECK(SentPost(post).all.empty());
}

TEST_CASE("progress is due an interval after it was told last") {
  Post post(1);
  Watchers watchers;
  CHECK(watchers.are_due(5));
  watchers.tell({.job = 1}, 5, post);
  CHECK_FALSE(watchers.are_due(5 + kProgressInterval_s / 2));
  CHECK(watchers.are_due(5 + 2 * kProgressInterval_s));
}
