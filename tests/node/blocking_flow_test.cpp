#include "node/parts/blocking_flow.hpp"

#include "catch.hpp"
#include "node/sent_mail.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

/// Each neighbour's queue has room for two rays.
struct Flow {
  Mail mail = mail_of_square();
  BlockingFlow flow{rules()};

  static FlowRules rules() {
    FlowRules rules;
    rules.links = 2;
    rules.link_credit_bytes = 2 * kRayBytes;
    return rules;
  }
  void leave(std::uint32_t bit, std::size_t rays) {
    flow.leave(bit, shadow_rays(rays), std::nullopt);
  }
  control::WaitReport report(std::uint64_t ping) {
    flow.answer_ping(ping, mail);
    const auto reports = SentMail(mail).told<control::WaitReport>();
    REQUIRE(reports.size() == 1);
    return reports.front();
  }
};

}  // namespace

TEST_CASE("each ray is a message, and a full queue holds up all that is behind") {
  Flow f;
  f.leave(0, 3);
  f.leave(1, 1);
  CHECK_FALSE(f.flow.send(false, f.mail));
  CHECK(SentMail(f.mail).counts(BatchType::kRays) == std::vector<std::uint32_t>{1, 1});
  CHECK(f.flow.is_stalled());
  CHECK_FALSE(f.flow.is_empty());
  // Room in another queue is of no use.
  CHECK_FALSE(f.flow.was_granted(1, kRayBytes, false, f.mail));
  CHECK(SentMail(f.mail).all.empty());
  CHECK(f.flow.was_granted(0, kRayBytes, false, f.mail));
  CHECK(SentMail(f.mail).counts(BatchType::kRays) == std::vector<std::uint32_t>{1, 1});
  CHECK_FALSE(f.flow.is_stalled());
}

TEST_CASE("room is given back at once") {
  Flow f;
  f.flow.taken(1, 1);
  f.flow.grant(0, f.mail);
  CHECK(SentMail(f.mail).all.empty());
  f.flow.grant(1, f.mail);
  CHECK(SentMail(f.mail).types() == std::vector{BatchType::kLinkCredit});
  f.flow.grant(1, f.mail);
  CHECK(SentMail(f.mail).all.empty());
}

TEST_CASE("a ping is answered with whom the evaluator waits for, and what has moved") {
  Flow f;
  f.flow.has_moved();
  f.flow.taken(1, 1);
  f.flow.grant(1, f.mail);
  SentMail{f.mail};
  CHECK_FALSE(f.report(4).is_stalled);
  f.leave(1, 3);
  f.flow.send(false, f.mail);
  SentMail{f.mail};
  const control::WaitReport report = f.report(5);
  CHECK(report.job == 1);
  CHECK(report.ping == 5);
  CHECK(report.is_stalled);
  CHECK(report.waits_for == 1);
  CHECK(report.moves == 1);
  CHECK(report.granted == std::vector<std::uint64_t>{0, kRayBytes});
  CHECK(report.received == std::vector<std::uint64_t>{0, 0});
}

TEST_CASE("evaluators get one ray or pixel at a time, in order, and nobody sends on class credit") {
  Flow f;
  CHECK(f.flow.pace().most_rays == 1);
  CHECK(f.flow.pace().is_one_by_one);
  CHECK_FALSE(f.flow.is_full());
  CHECK_FALSE(f.flow.add_class_rays(0, shadow_rays(1)));
  CHECK_FALSE(f.flow.has_class_work());
}
