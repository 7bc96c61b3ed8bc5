#include "node/parts/helping.hpp"

#include "catch.hpp"
#include "node/sent_mail.hpp"

using namespace graycube;
using namespace graycube::testing;
using Kind = Helping::Gift::Kind;

namespace {

constexpr std::size_t kNoLimit = 1 << 20;

/// A node that has traced ten tiles of 100 tests each; its neighbour across bit 0 has done nothing.
struct Owner {
  Mail mail = mail_of_square();
  Helping helping{2, {true, 1000}};

  Owner() {
    for (int i = 0; i < 10; ++i) helping.has_traced(100, true);
  }
  void hear(BatchType type, std::uint64_t work = 0) {
    REQUIRE(helping.on_offer(0, encode_offer({1, 0, 1, 7, 0}, type, work), type, kAnything, mail));
  }
  Helping::Gift gift(const Helping::Supply& supply, std::size_t most_rays = kNoLimit) {
    return helping.gift_for(0, supply, most_rays);
  }
};

}  // namespace

TEST_CASE("nobody who has not offered gets anything") {
  Owner owner;
  CHECK_FALSE(owner.helping.has_offer(0));
  CHECK(owner.gift({100, 100, 0, 0}).kind == Kind::kNothing);
}

TEST_CASE("who is idle is recommended for a copy, once, when there are tiles enough") {
  Owner owner;
  owner.hear(BatchType::kIdle);
  CHECK(owner.gift({15, 15, 0, 0}).kind == Kind::kNothing);
  CHECK(owner.gift({16, 16, 0, 0}).kind == Kind::kCopy);
  CHECK(owner.gift({16, 16, 0, 0}).kind == Kind::kNothing);
}

TEST_CASE("who has a copy gets half of the tiles, no more than are own ones, for one offer") {
  Owner owner;
  owner.hear(BatchType::kIdleWithCopy);
  const Helping::Gift gift = owner.gift({8, 3, 0, 0});
  CHECK(gift.kind == Kind::kTiles);
  CHECK(gift.most == 3);
  CHECK(owner.gift({8, 3, 0, 0}).kind == Kind::kNothing);
  owner.hear(BatchType::kIdleWithCopy);
  CHECK(owner.gift({1000, Helping::kMostTiles, 0, 0}).most == Helping::kMostTiles);
}

TEST_CASE("who has done as much as this node will have gets nothing") {
  Owner owner;
  owner.hear(BatchType::kIdleWithCopy, 1000 + 8 * 100);
  CHECK(owner.gift({8, 8, 0, 0}).kind == Kind::kNothing);
  owner.hear(BatchType::kIdleWithCopy, 1000 + 8 * 100 - 400);
  CHECK(owner.gift({8, 8, 0, 0}).most == 2);
}

TEST_CASE("where there are no tiles rays are given, as far as credit goes") {
  Owner owner;
  owner.hear(BatchType::kIdleWithCopy);
  CHECK(owner.gift({0, 0, 0, 1023}).kind == Kind::kNothing);
  CHECK(owner.gift({0, 0, 0, 2000}, 0).kind == Kind::kNothing);
  const Helping::Gift gift = owner.gift({0, 0, 0, 2000}, 300);
  CHECK(gift.kind == Kind::kRays);
  CHECK(gift.most == 300);
}

TEST_CASE("an idle node tells each neighbour once, until that has given something") {
  Owner idle;
  idle.helping.offer(idle.mail);
  CHECK(SentMail(idle.mail).types() == std::vector{BatchType::kIdle, BatchType::kIdle});
  idle.helping.offer(idle.mail);
  CHECK(SentMail(idle.mail).all.empty());
  idle.helping.has_given(1);
  idle.helping.offer(idle.mail);
  CHECK(SentMail(idle.mail).all.size() == 1);
  Helping off(2, {false, 0});
  off.offer(idle.mail);
  CHECK(SentMail(idle.mail).all.empty());
}
