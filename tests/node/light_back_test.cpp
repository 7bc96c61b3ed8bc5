#include "node/parts/returns/light_back.hpp"

#include "catch.hpp"
#include "node/sent_mail.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

constexpr std::uint64_t kPixels = 1 << 10;
constexpr std::int64_t kMost = kMaxMergedLight;

RayTask ray_of(std::uint32_t pixel, std::uint8_t exponent, RayKind kind = RayKind::kReflection) {
  RayTask ray = shadow_ray();
  ray.kind = kind;
  ray.pixel = pixel;
  ray.credit_exponent = exponent;
  return ray;
}

PixelReturn light_for(std::uint32_t key, const FixedRgb& light, int exponent) {
  PixelReturn r{key, 1, light, {}};
  r.credit.add_power(exponent);
  return r;
}

/// The part, its mail, and the neighbours across two links.
struct Back {
  Mail mail = mail_of_square();
  LightBack back;

  explicit Back(std::size_t most_open = 1 << 8) : back(2, kPixels, most_open) {}

  /// The key under which a ray is known that came with that number.
  std::uint32_t key_of(std::uint32_t bit, std::uint32_t number, std::uint8_t exponent) {
    RayTask ray = ray_of(number, exponent);
    REQUIRE(back.came(bit, {&ray, 1}));
    return ray.pixel;
  }
  /// The number that a ray carries which leaves under that key.
  std::uint32_t number_of(std::uint32_t bit, std::uint32_t key, std::uint8_t exponent) {
    RayTask ray = ray_of(key, exponent);
    REQUIRE(back.leave(bit, {&ray, 1}));
    return ray.pixel;
  }
  std::vector<PixelReturn> take(const PixelReturn& light) { return back.take({&light, 1}, mail); }
  /// What is complete once the neighbour across `bit` has sent these answers.
  std::optional<std::vector<PixelReturn>> receive(std::uint32_t bit,
                                                  const std::vector<RayAnswer>& answers) {
    const BatchStamp stamp{1, 0, 1u << bit, 7, 0};
    return back.on_answers(bit, encode_answers(stamp, answers), kAnything, mail);
  }
  /// The answers sent so far, in one vector for each link.
  std::vector<std::vector<RayAnswer>> sent() {
    std::vector<std::vector<RayAnswer>> all(2);
    for (const Mail::Outgoing& o : SentMail(mail).all) {
      std::vector<RayAnswer> answers;
      const auto result = decode_answers(o.message.frame, kAnything, answers);
      REQUIRE(std::holds_alternative<BatchHeader>(result));
      auto& link = all[o.to == Rank{2}];
      link.insert(link.end(), answers.begin(), answers.end());
    }
    return all;
  }
  bool has_failed() { return SentMail(mail).told<control::NodeError>().size() == 1; }
};

}  // namespace

TEST_CASE("a ray that came is answered once, under its number, when all its credit is back") {
  Back b;
  const std::uint32_t key = b.key_of(1, 77, 2);
  CHECK(b.back.open() == 1);
  CHECK(b.take(light_for(key, {1, 2, 3}, 3)).empty());
  CHECK(b.back.is_empty());
  CHECK(b.take(light_for(key, {10, 20, 30}, 3)).empty());
  CHECK_FALSE(b.back.is_empty());
  CHECK(b.back.open() == 0);
  b.back.send(b.mail);
  CHECK(b.mail.take_counted().work == 1);
  const auto sent = b.sent();
  CHECK(sent[0].empty());
  CHECK(sent[1] == std::vector<RayAnswer>{{77, true, {11, 22, 33}}});
  CHECK(b.back.is_empty());
}

TEST_CASE("a ray is answered only after the rays that it sent on across links") {
  Back b;
  const std::uint32_t key = b.key_of(0, 5, 1);
  const std::uint32_t shadow = b.number_of(1, key, 3), mirror = b.number_of(0, key, 3);
  CHECK(shadow != mirror);
  CHECK(b.take(light_for(key, {1, 0, 0}, 2)).empty());
  REQUIRE(b.receive(1, {{shadow, true, {0, 0, 0}}}));
  CHECK(b.back.is_empty());
  REQUIRE(b.receive(0, {{mirror, true, {2, 3, 4}}}));
  b.back.send(b.mail);
  CHECK(b.sent()[0] == std::vector<RayAnswer>{{5, true, {3, 3, 4}}});
  CHECK(b.back.open() == 0);
}

TEST_CASE("a pixel's light is kept until its ray is complete, and then goes on as one sum") {
  Back b;
  const std::uint32_t number = b.number_of(1, 9, 1);
  CHECK(b.take(light_for(9, {1, 2, 3}, 1)).empty());
  CHECK(b.back.open() == 2);  // the ray, and the pixel
  const auto complete = b.receive(1, {{number, true, {10, 20, 30}}});
  REQUIRE(complete);
  REQUIRE(complete->size() == 1);
  CHECK(complete->front().pixel == 9);
  CHECK(complete->front().light == FixedRgb{11, 22, 33});
  CHECK(complete->front().credit.is_exactly(1));
  CHECK(b.back.open() == 0);
}

TEST_CASE("light of whole primary rays, and AOVs, go on as they are") {
  Back b;
  const std::vector<PixelReturn> returns{
      light_for(3, {1, 2, 3}, 0), {static_cast<std::uint32_t>(kPixels + 3), 1, {4, 5, 6}, {}}};
  const auto complete = b.back.take(returns, b.mail);
  REQUIRE(complete.size() == 2);
  CHECK(complete[0].light == FixedRgb{1, 2, 3});
  CHECK(complete[1].light == FixedRgb{4, 5, 6});
  CHECK(b.back.open() == 0);
}

TEST_CASE("a primary ray keeps its pixel wherever it goes, and nobody is owed an answer") {
  Back b;
  RayTask ray = ray_of(12, 0, RayKind::kPrimary);
  REQUIRE(b.back.leave(0, {&ray, 1}));
  REQUIRE(b.back.came(0, {&ray, 1}));
  CHECK(ray.pixel == 12);
  CHECK(b.back.open() == 0);
}

TEST_CASE("answers to unknown rays, from another link, twice or broken fail the job") {
  const auto is_refused = [](auto&& answer) {
    Back b;
    const std::uint32_t number = b.number_of(1, 9, 1);
    CHECK_FALSE(answer(b, number));
    CHECK(b.mail.drops() == 1);
    return b.has_failed();
  };
  CHECK(is_refused([](Back& b, std::uint32_t n) { return b.receive(1, {{n + 1, true, {}}}); }));
  CHECK(is_refused([](Back& b, std::uint32_t n) { return b.receive(0, {{n, true, {}}}); }));
  CHECK(is_refused([](Back& b, std::uint32_t n) {
    return b.receive(1, {{n, true, {}}, {n, true, {}}});
  }));
  CHECK(is_refused([](Back& b, std::uint32_t n) {
    // The place of the first ray is taken by another meanwhile.
    REQUIRE(b.receive(1, {{n, true, {}}}));
    CHECK((b.number_of(1, 9, 1) & 0xFFFF) == (n & 0xFFFF));
    return b.receive(1, {{n, true, {}}});
  }));
  CHECK(is_refused([](Back& b, std::uint32_t) {
    return b.back.on_answers(1, encode_link_credit({1, 0, 2, 7, 0}, 5), kAnything, b.mail);
  }));
}

TEST_CASE("light too bright for one record goes back in parts, the last of which says so") {
  Back b;
  const std::uint32_t key = b.key_of(0, 5, 0), number = b.number_of(1, key, 1);
  CHECK(b.take(light_for(key, {kMost, 1, 1}, 1)).empty());
  REQUIRE(b.receive(1, {{number, false, {1, 1, 1}}, {number, true, {1, 0, 0}}}));
  b.back.send(b.mail);
  CHECK(b.sent()[0] == std::vector<RayAnswer>{{5, false, {kMost, 1, 1}}, {5, true, {2, 1, 1}}});

  const std::uint32_t other = b.number_of(1, 9, 1);
  CHECK(b.take(light_for(9, {kMost, 0, 0}, 1)).empty());
  const auto complete = b.receive(1, {{other, true, {kMost, 0, 0}}});
  REQUIRE(complete);
  REQUIRE(complete->size() == 2);
  CHECK((*complete)[0].light.r == kMost);
  CHECK((*complete)[0].credit.is_zero());
  CHECK((*complete)[1].light.r == kMost);
  CHECK((*complete)[1].credit.is_exactly(1));
}

TEST_CASE("no more rays are open than may be, in either direction") {
  Back b(2);
  std::vector<RayTask> rays(3, ray_of(1, 1));
  CHECK_FALSE(b.back.came(0, rays));
  b.back.reset();
  rays.assign(3, ray_of(1, 1));
  CHECK_FALSE(b.back.leave(0, rays));
  b.back.reset();
  rays.assign(2, ray_of(1, 1));
  CHECK(b.back.leave(0, rays));
}

TEST_CASE("a node with very many open rays begins no tiles until some are answered") {
  Back b(LightBack::kManyOpen);
  std::vector<RayTask> rays(1 << 10);
  for (std::size_t came = 0; came < LightBack::kManyOpen; came += rays.size()) {
    CHECK(b.back.may_start_tiles());
    rays.assign(rays.size(), ray_of(1, 1));
    REQUIRE(b.back.came(0, rays));
  }
  CHECK_FALSE(b.back.may_start_tiles());
  b.take(light_for(rays.front().pixel, {1, 1, 1}, 1));
  CHECK(b.back.may_start_tiles());
}

TEST_CASE("a link's answers are sent by themselves once there are many") {
  Back b(LightBack::kFullAnswers + 1);
  for (std::uint32_t n = 0; n < LightBack::kFullAnswers; ++n) {
    CHECK(b.sent()[0].empty());
    b.take(light_for(b.key_of(0, n, 1), {1, 1, 1}, 1));
  }
  CHECK(b.sent()[0].size() == LightBack::kFullAnswers);
  CHECK(b.back.is_empty());
}

TEST_CASE("a new epoch forgets what is open, and the report counts what was") {
  Back b;
  const std::uint32_t key = b.key_of(0, 5, 1), number = b.number_of(1, key, 2);
  b.take(light_for(7, {1, 1, 1}, 1));
  b.take(light_for(b.key_of(0, 6, 1), {1, 1, 1}, 1));
  b.back.reset();
  CHECK(b.back.open() == 0);
  CHECK(b.back.is_empty());
  CHECK_FALSE(b.receive(1, {{number, true, {}}}));
  b.take(light_for(b.key_of(0, 6, 1), {1, 1, 1}, 1));
  b.mail.take();
  b.back.send(b.mail);
  control::NodeStats stats;
  b.back.report(stats);
  CHECK(stats.open_peak == 4);
  CHECK(stats.open_bytes_peak > 4 * 8);
  CHECK(stats.answers == 2);
  CHECK(stats.answer_batches == 1);
  CHECK(stats.answer_bytes == SentMail(b.mail).all.front().message.frame.size());
}
