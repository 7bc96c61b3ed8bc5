#include "node/parts/ending.hpp"

#include "catch.hpp"
#include "node/sent_mail.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Rank 0 of a farm with `nodes` nodes.
struct Initiator {
  Mail mail = mail_of_square();
  Ending ending;

  explicit Initiator(std::uint32_t nodes, bool never_rests = false)
      : ending({*Hypercube::of_size(nodes), Rank{0}}, never_rests) {}
  void pass(bool is_passive, std::optional<std::uint64_t> ping = std::nullopt) {
    ending.pass(is_passive, ping, mail);
  }
  /// Gives the token back as it is.
  bool comes_back(const Token& token) {
    return ending.on_token(encode_token({1, 0, 2, 7, 0}, token), kAnything, mail);
  }
};

std::size_t tokens(Mail& mail) { return SentMail(mail).counts(BatchType::kToken).size(); }

}  // namespace

TEST_CASE(
    "a node alone finds the end as soon as it is passive, and tells how much light it has sent") {
  Initiator alone(1);
  alone.mail.light_to_frontal(
      [](const BatchStamp& stamp) { return encode_contributions(stamp, {}, {}); });
  alone.pass(false);
  CHECK(SentMail(alone.mail).told<control::Terminated>().empty());
  alone.pass(true);
  const auto ends = SentMail(alone.mail).told<control::Terminated>();
  REQUIRE(ends.size() == 1);
  CHECK(ends.front().contribution_batches == 1);
  alone.pass(true);
  CHECK(SentMail(alone.mail).all.empty());
}

TEST_CASE(
    "the token starts when the node is passive, and a second time; then it waits for a hint at the "
    "end") {
  Initiator first(4);
  first.ending.work_came();
  first.pass(false);
  CHECK(tokens(first.mail) == 0);
  first.pass(true);
  CHECK(tokens(first.mail) == 1);
  Token token{.black = true, .round = 1, .hops = 4};
  REQUIRE(first.comes_back(token));
  first.pass(true);
  CHECK(tokens(first.mail) == 1);
  token.round = 2;
  REQUIRE(first.comes_back(token));
  first.pass(true);
  CHECK(tokens(first.mail) == 0);
  SECTION("that all tiles are whole") {
    first.ending.all_are_whole();
    first.pass(true);
    CHECK(tokens(first.mail) == 1);
  }
  SECTION("or for the eighth ping") {
    first.pass(true, 7);
    CHECK(tokens(first.mail) == 0);
    first.pass(true, 8);
    CHECK(tokens(first.mail) == 1);
  }
}

TEST_CASE("as in 1987 the token goes round all the time") {
  Initiator first(4, true);
  first.pass(true);
  for (std::uint32_t round = 1; round < 10; ++round) {
    CHECK(tokens(first.mail) == 1);
    REQUIRE(first.comes_back({.black = true, .round = round, .hops = 4 * round}));
    first.pass(true);
  }
}

TEST_CASE("what was sent and never came is told after enough rounds, one for each ping") {
  Initiator first(4);
  first.mail.work_to_neighbour(0,
                               [](const BatchStamp& s) { return encode_rays(s, shadow_rays(1)); });
  first.ending.all_are_whole();
  first.pass(true);
  std::vector<control::NodeError> errors;
  std::uint32_t round = 1;
  for (; round < 100 && errors.empty(); ++round) {
    REQUIRE(first.comes_back({.round = round, .hops = 4 * round}));
    first.pass(true, round);
    errors = SentMail(first.mail).told<control::NodeError>();
  }
  REQUIRE(errors.size() == 1);
  CHECK(errors.front().message == "1 batches of rays were sent by nodes but never received by any");
  CHECK(round == 33);
}

TEST_CASE("a token that was not due is dropped") {
  Initiator first(4);
  CHECK_FALSE(first.comes_back({.round = 1}));
  CHECK(first.mail.drops() == 1);
  CHECK_FALSE(first.ending.on_token({}, kAnything, first.mail));
  CHECK(first.mail.drops() == 2);
}
