#include "node/parts/borrowing.hpp"

#include "catch.hpp"
#include "node/sent_mail.hpp"

using namespace graycube;
using namespace graycube::testing;
using Place = Borrowing::Place;

TEST_CASE("a model is asked for once, and rays wait until it comes") {
  Mail mail = mail_of_square();
  Borrowing borrowing(4, true, 1000);
  for (int i = 0; i < 3; ++i)
    CHECK(borrowing.place_of(Rank{2}, shadow_ray(), mail) == Place::kWaits);
  CHECK(borrowing.is_asked(Rank{2}));
  CHECK_FALSE(borrowing.is_asked(Rank{1}));
  CHECK_FALSE(borrowing.is_asked(Rank{4}));
  CHECK(SentMail(mail).told<control::Borrow>() == std::vector{control::Borrow{1, 0, 2, 250}});
  CHECK(borrowing.came(Rank{2}, 600).size() == 3);
  CHECK(borrowing.place_of(Rank{2}, shadow_ray(), mail) == Place::kHere);
  // The room that is left is smaller now.
  CHECK(borrowing.place_of(Rank{3}, shadow_ray(), mail) == Place::kWaits);
  CHECK(SentMail(mail).told<control::Borrow>() == std::vector{control::Borrow{1, 0, 3, 100}});
  control::NodeStats stats;
  borrowing.report(stats);
  CHECK(stats.models_borrowed == 1);
}

TEST_CASE("rays go on with the neighbour when there is no room, here or in the answer") {
  Mail mail = mail_of_square();
  Borrowing none(4, true, 0);
  CHECK(none.place_of(Rank{1}, shadow_ray(), mail) == Place::kThere);
  CHECK(SentMail(mail).all.empty());
  Borrowing some(4, true, 8);
  CHECK(some.place_of(Rank{1}, shadow_ray(), mail) == Place::kWaits);
  CHECK(some.was_refused(Rank{1}).size() == 1);
  CHECK(some.place_of(Rank{1}, shadow_ray(), mail) == Place::kThere);
}

TEST_CASE("in a new epoch no ray waits, and models that are here stay") {
  Mail mail = mail_of_square();
  Borrowing borrowing(4, true, 1000);
  borrowing.place_of(Rank{1}, shadow_ray(), mail);
  borrowing.place_of(Rank{2}, shadow_ray(), mail);
  borrowing.came(Rank{1}, 10);
  borrowing.reset();
  CHECK(borrowing.came(Rank{2}, 10).empty());
  CHECK(borrowing.place_of(Rank{1}, shadow_ray(), mail) == Place::kHere);
}
