#include "node/parts/light_out.hpp"

#include "catch.hpp"
#include "node/sent_mail.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

const Hypercube kSquare = *Hypercube::of_size(4);
const TilePlan kPlan(ImageSize{64, 64, 1}, TileShape{});

PixelReturn light_of(std::uint32_t pixel) {
  PixelReturn r;
  r.pixel = pixel;
  r.merged = 1;
  r.light = {1, 2, 3};
  r.credit.add_power(0);
  return r;
}

Bytes sums_of(Rank sender) {
  const Contribution c{5, {10, 20, 30}};
  return encode_contributions({1, 0, sender.value, 7, 0}, {}, std::span(&c, 1));
}

}  // namespace

TEST_CASE("light goes to the frontal when it is sent for, and nothing does when there is none") {
  Mail mail = mail_of_square();
  LightOut light({kSquare, Rank{0}}, SumsMode::kDirect);
  light.send(mail);
  CHECK(SentMail(mail).all.empty());
  light.add(std::vector{light_of(1), light_of(2)}, std::nullopt, kPlan, mail);
  CHECK_FALSE(light.is_empty());
  CHECK(SentMail(mail).all.empty());
  light.send(mail);
  const SentMail sent(mail);
  REQUIRE(sent.all.size() == 1);
  CHECK_FALSE(sent.all.front().to);
  CHECK(light.is_empty());
  CHECK(mail.take_counted().light == 1);
}

TEST_CASE("a leaf of the tree of sums sends light to its parent, as work for the token") {
  Mail mail(BatchStamp{1, 0, 1, 7, 0});
  const Seat seat{kSquare, Rank{1}};
  mail.set_peers({seat.peer(0), seat.peer(1)});
  LightOut light(seat, SumsMode::kTree);
  light.add(std::vector{light_of(1)}, 0, kPlan, mail);
  light.send(mail);
  const SentMail sent(mail);
  REQUIRE(sent.all.size() == 1);
  CHECK(sent.all.front().to == kSquare.tree_parent(Rank{1}));
  CHECK(mail.take_counted().work == 1);
  control::NodeStats stats;
  light.report(stats);
  CHECK(stats.sum_batches == 1);
  CHECK(stats.contribution_batches == 0);
}

TEST_CASE("only a child's light is taken in, and only where there is a tree") {
  Mail mail = mail_of_square();
  LightOut root({kSquare, Rank{0}}, SumsMode::kTree), direct({kSquare, Rank{0}}, SumsMode::kDirect);
  CHECK(root.on_sums(0, sums_of(Rank{1}), kAnything, mail));
  CHECK(root.holds_others_light());
  root.reset();
  CHECK_FALSE(root.holds_others_light());
  CHECK(root.is_empty());
  CHECK_FALSE(direct.on_sums(0, sums_of(Rank{1}), kAnything, mail));
  CHECK(SentMail(mail).told<control::NodeError>().size() == 1);
}

TEST_CASE("a buffer that is full is sent by itself") {
  Mail mail = mail_of_square();
  const TilePlan plan(ImageSize{256, 256, 1}, TileShape{});
  LightOut light({kSquare, Rank{0}}, SumsMode::kDirect);
  std::vector<PixelReturn> all;
  for (std::uint32_t pixel = 0; pixel < MergeBuffer::kFullPixels + 1; ++pixel)
    all.push_back(light_of(pixel));
  light.add(all, std::nullopt, plan, mail);
  CHECK(SentMail(mail).all.size() == 1);
  CHECK_FALSE(light.is_empty());
}
