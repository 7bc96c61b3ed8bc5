#include "node/parts/credit_flow.hpp"

#include "catch.hpp"
#include "node/sent_mail.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

using Counts = std::vector<std::uint32_t>;

/// Two links with credit for eight rays each, batches of four, full with ten in the outboxes.
struct Flow {
  Mail mail = mail_of_square();
  CreditFlow flow{rules()};

  static FlowRules rules() {
    FlowRules rules;
    rules.links = 2;
    rules.link_credit_bytes = 8 * kRayBytes;
    rules.batch_bytes = 4 * kRayBytes;
    rules.outbox_rays = 10;
    return rules;
  }
  void leave(std::size_t rays) { flow.leave(0, shadow_rays(rays), std::nullopt); }
  Counts sent(bool partial) {
    flow.send(partial, mail);
    return SentMail(mail).counts(BatchType::kRays);
  }
};

}  // namespace

TEST_CASE("what there is no credit for waits in the outbox until there is") {
  Flow f;
  f.leave(9);
  CHECK(f.sent(true) == Counts{4, 4});
  CHECK_FALSE(f.flow.is_empty());
  CHECK(f.flow.gift_room(0) == 0);
  f.flow.was_granted(0, kRayBytes, true, f.mail);
  CHECK(SentMail(f.mail).counts(BatchType::kRays) == Counts{1});
  CHECK(f.flow.is_empty());
}

TEST_CASE("part of a batch goes out when asked for, or while little is under way") {
  Flow f;
  f.leave(5);
  CHECK(f.sent(false) == Counts{4});
  CHECK(f.sent(false).empty());
  CHECK(f.sent(true) == Counts{1});
}

TEST_CASE("a node is full with what waits in its outboxes and what it has reserved") {
  Flow f;
  f.leave(6);
  CHECK_FALSE(f.flow.is_full());
  f.flow.reserve(4);
  CHECK(f.flow.is_full());
  CHECK_FALSE(f.flow.may_start_tiles());
  f.flow.release(1);
  CHECK_FALSE(f.flow.is_full());
}

TEST_CASE("a full node keeps what would pass through, and its credit") {
  Flow f;
  f.leave(10);
  CHECK_FALSE(f.flow.pass_on(0, 1, shadow_rays(8)));
  CHECK(f.flow.held() == 8);
  f.flow.grant(0, f.mail);
  CHECK(SentMail(f.mail).all.empty());
  f.sent(true);
  f.flow.pass_on_what_waits();
  CHECK(f.flow.held() == 0);
  f.flow.grant(0, f.mail);
  CHECK(SentMail(f.mail).types() == std::vector{BatchType::kLinkCredit});
}

TEST_CASE("credit is given back by halves at work, and by eighths when there is nothing to do") {
  Flow f;
  f.flow.taken(0, 3);
  f.flow.grant(0, f.mail);
  CHECK(SentMail(f.mail).all.empty());
  f.flow.flush(f.mail);
  CHECK(SentMail(f.mail).types() == std::vector{BatchType::kLinkCredit});
  f.flow.taken(0, 4);
  f.flow.grant(0, f.mail);
  CHECK(SentMail(f.mail).types() == std::vector{BatchType::kLinkCredit});
}

TEST_CASE("a class has so many places on a link, and they come back when its rays are taken") {
  Flow f;
  CHECK(f.flow.add_class_rays(1, shadow_rays(1, 3)));
  CHECK_FALSE(f.flow.add_class_rays(1, shadow_rays(1, 3)));
  CHECK(f.flow.has_class_work());
  const auto here = [](const RegionIndex&) -> std::optional<std::uint32_t> { return std::nullopt; };
  const auto work = f.flow.take_class_work(here, f.mail);
  REQUIRE(work);
  CHECK(work->rays.size() == 1);
  CHECK_FALSE(work->on_class);
  CHECK(SentMail(f.mail).types() == std::vector{BatchType::kClassCredit});
  CHECK(f.flow.add_class_rays(1, shadow_rays(1, 3)));
}

TEST_CASE("a full node's work is of one class, and what it sends on of the next") {
  Flow f;
  // Eight rays go on credit, and one in its class's place.
  f.leave(19);
  f.sent(true);
  REQUIRE(f.flow.is_full());
  SentMail{f.mail};
  CHECK(f.flow.add_class_rays(1, shadow_rays(1, 3)));
  const auto here = [](const RegionIndex&) -> std::optional<std::uint32_t> { return std::nullopt; };
  const auto work = f.flow.take_class_work(here, f.mail);
  REQUIRE(work);
  CHECK(work->on_class == std::uint16_t{3});
  // Room for its children is kept until its work has ended.
  CHECK(f.flow.add_class_rays(1, shadow_rays(1, 3)));
  CHECK_FALSE(f.flow.has_class_work());
  f.flow.class_work_ended(3, {});
  CHECK(f.flow.has_class_work());
}

TEST_CASE("a new epoch begins with nothing under way and all credit") {
  Flow f;
  f.leave(20);
  f.sent(true);
  f.flow.reserve(3);
  f.flow.reset();
  CHECK(f.flow.is_empty());
  CHECK(f.flow.gift_room(0) == 8);
}
