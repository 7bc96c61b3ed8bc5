#include "frontal/parts/post.hpp"

#include "catch.hpp"
#include "frontal/sent_post.hpp"

using namespace graycube;
using namespace graycube::testing;

TEST_CASE("nodes are sent what is for all, but for those that cannot be reached") {
  Post post = post_of(3);
  post.set_node(Rank{1}, {});
  post.to_nodes(control::Ping{1});
  CHECK(SentPost(post).names() == std::vector<std::string>{"node 0: ping", "node 2: ping"});
  post.set_node(Rank{1}, "elsewhere");
  post.to_node(Rank{1}, control::Ping{2});
  const SentPost sent(post);
  REQUIRE(sent.all.size() == 1);
  CHECK(sent.told<control::Ping>("elsewhere").front().sequence == 2);
  CHECK(SentPost(post).all.empty());
}

TEST_CASE("each node gets the payload that is its own") {
  Post post = post_of(4);
  post.to_each_node(control::Load{.job = 5}, [](Rank rank) { return Bytes(rank.value + 1); });
  const SentPost sent(post);
  REQUIRE(sent.all.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(sent.all[i].to == peer_of(static_cast<std::uint32_t>(i)));
    CHECK(sent.all[i].message.payload.size() == i + 1);
  }
}

TEST_CASE(
    "a refusal is a failed message that names the job, the place and the "
    "reason") {
  Post post(1);
  post.answer("client", Refusal{7, FailureCode::kNotDone, "where", "why"});
  const auto failed = SentPost(post).told<control::Failed>("client");
  REQUIRE(failed.size() == 1);
  CHECK(failed.front() ==
        control::Failed{7, FailureCode::kNotDone, {{"where", "why"}}, std::nullopt});
  post.answer("client", Reply{control::Accepted{8}});
  CHECK(SentPost(post).told<control::Accepted>("client").front().job == 8);
}
