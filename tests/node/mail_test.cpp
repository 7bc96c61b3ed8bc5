#include "node/parts/mail.hpp"

#include "catch.hpp"
#include "node/sent_mail.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

const auto kGrant = [](const BatchStamp& stamp) { return encode_link_credit(stamp, 1); };

}  // namespace

TEST_CASE("batches are numbered on each link by itself, from 0 again in each epoch") {
  Mail mail = mail_of_square();
  mail.to_neighbour(0, kGrant);
  mail.to_neighbour(0, kGrant);
  mail.to_neighbour(1, kGrant);
  mail.light_to_frontal(kGrant);
  BatchStamp next = kFirst;
  next.epoch = 1;
  mail.begin(next);
  mail.to_neighbour(0, kGrant);
  std::vector<std::uint64_t> numbers, epochs;
  for (const BatchHeader& h : SentMail(mail).headers()) {
    numbers.push_back(h.stamp.sequence);
    epochs.push_back(h.stamp.epoch);
  }
  CHECK(numbers == std::vector<std::uint64_t>{0, 1, 0, 0, 0});
  CHECK(epochs == std::vector<std::uint64_t>{0, 0, 0, 0, 1});
}

TEST_CASE("greetings are not numbered") {
  Mail mail = mail_of_square();
  mail.signal(0, BatchType::kGreeting);
  mail.to_neighbour(0, kGrant);
  for (const BatchHeader& h : SentMail(mail).headers()) CHECK(h.stamp.sequence == 0);
}

TEST_CASE("a number that was left out is noticed, and so is one that comes twice") {
  Mail mail = mail_of_square();
  CHECK(mail.is_next_from(1, 0));
  CHECK(mail.is_next_from(1, 1));
  CHECK_FALSE(mail.is_next_from(1, 1));
  CHECK_FALSE(mail.is_next_from(0, 1));
  CHECK(mail.is_next_from_frontal(0));
  CHECK_FALSE(mail.is_next_from_frontal(2));
}

TEST_CASE("only work and light count for the token, once each") {
  Mail mail = mail_of_square();
  mail.to_neighbour(0, kGrant);
  mail.work_to_neighbour(0, kGrant);
  mail.work_to_neighbour(1, kGrant);
  mail.light_to_frontal(kGrant);
  const Mail::Counted counted = mail.take_counted();
  CHECK(counted.work == 2);
  CHECK(counted.light == 1);
  CHECK(mail.take_counted().work == 0);
}

TEST_CASE("mail leaves in the order in which it was written, for whom it is meant") {
  Mail mail = mail_of_square();
  mail.to_neighbour(1, kGrant);
  mail.fail("no reason");
  mail.to_neighbour(0, kGrant);
  const SentMail sent(mail);
  REQUIRE(sent.all.size() == 3);
  CHECK(sent.all[0].to == Rank{2});
  CHECK_FALSE(sent.all[1].to);
  CHECK(sent.all[2].to == Rank{1});
  CHECK(sent.told<control::NodeError>() == std::vector{control::NodeError{1, 0, "no reason"}});
  CHECK(mail.is_empty());
}
