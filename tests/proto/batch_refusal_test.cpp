// Batches that nobody can have sent are refused, and say why.
#include <array>
#include <cstring>
#include <functional>

#include "catch.hpp"
#include "fuzz/proto_fuzz.hpp"
#include "proto/batch.hpp"
#include "proto/batch_samples.hpp"
#include "proto/bytes.hpp"
#include "proto/random.hpp"

using namespace graycube;
using namespace graycube::test;

TEST_CASE("runs of light that nobody would write are refused") {
  // Pixels 7 and 8, in two bytes a component.
  const std::vector<Contribution> light{{7, {1, 0x0304, 0}}, {8, {5, 6, 7}}};
  const Bytes good = encode_contributions(kStamp, {}, light);
  std::vector<TileCredit> credits;
  std::vector<Contribution> again;
  const auto error = [&](const Bytes& bytes) {
    again.resize(3);
    const BatchError e = error_of(decode_contributions(bytes, kLimits, credits, again));
    CHECK(again.empty());
    return e;
  };
  REQUIRE(decode_contributions(good, kLimits, credits, again).index() == 0);
  CHECK(error(with(good, 44, std::uint32_t{4095})) == BatchError::kBadValue);
  CHECK(error(with(good, 44, std::uint32_t{0xFFFFFFFF})) == BatchError::kBadValue);
  for (const int count : {0, 1, 3, 255}) {
    INFO(count << " pixels");
    CHECK(error(with(good, 48, static_cast<std::uint8_t>(count))) == BatchError::kBadValue);
  }
  for (const int width : {0, 1, 3, 8, 9, 255}) {
    INFO(width << " bytes a component");
    CHECK(error(with(good, 49, static_cast<std::uint8_t>(width))) == BatchError::kBadValue);
  }
  CHECK(error(with(good, 32, std::uint32_t{1})) == BatchError::kBadValue);
  CHECK(error(with(good, 32, std::uint32_t{3})) == BatchError::kBadValue);
  CHECK(error(with(good, 32, std::uint32_t{7})) == BatchError::kBadLength);
  CHECK(error(with(good, 32, std::uint32_t{0})) == BatchError::kBadLength);
  // No component needs its second byte now.
  CHECK(error(with(good, 44 + 6 + 2, std::uint16_t{4})) == BatchError::kBadValue);
}

TEST_CASE("a run that could have been longer is refused, but for the longest") {
  std::vector<Contribution> light;
  for (std::uint32_t pixel = 0; pixel < 300; ++pixel) light.push_back({pixel, {1, 2, 3}});
  std::vector<TileCredit> credits;
  std::vector<Contribution> again;
  const Bytes whole = encode_contributions(kStamp, {}, light);
  CHECK(whole.size() == 44 + 2 * 6 + 300 * 3);
  REQUIRE(decode_contributions(whole, kLimits, credits, again).index() == 0);
  CHECK(again == light);
  light[1].pixel = 900;
  light.resize(2);
  const Bytes apart = encode_contributions(kStamp, {}, light);
  CHECK(error_of(decode_contributions(with(apart, 44 + 6 + 3, std::uint32_t{1}), kLimits, credits,
                                      again)) == BatchError::kBadValue);
}

TEST_CASE("the frontal may send batches, a rank that doesn't exist may not") {
  BatchStamp stamp = kStamp;
  stamp.sender = kFrontalRank;
  std::vector<std::uint32_t> tiles;
  CHECK(decode_assignment(encode_assignment(stamp, {}), kLimits, tiles).index() == 0);
  stamp.sender = kLimits.nodes;
  CHECK(error_of(decode_assignment(encode_assignment(stamp, {}), kLimits, tiles)) ==
        BatchError::kBadValue);
}

TEST_CASE("a damaged header is refused, and the error says what is wrong") {
  Random random(2);
  const Bytes good = encode_rays(kStamp, some_rays(random, 2));
  REQUIRE(peek_header(good).index() == 0);
  CHECK(error_of(peek_header(with(good, 0, std::uint32_t{0}))) == BatchError::kBadMagic);
  CHECK(error_of(peek_header(with(good, 4, std::uint16_t{4}))) == BatchError::kBadVersion);
  CHECK(error_of(peek_header(with(good, 6, std::uint8_t{0}))) == BatchError::kBadType);
  CHECK(error_of(peek_header(with(good, 6, std::uint8_t{16}))) == BatchError::kBadType);
  CHECK(error_of(peek_header(with(good, 7, std::uint8_t{1}))) == BatchError::kBadValue);
  CHECK(error_of(peek_header(with(good, 28, std::uint32_t{3}))) == BatchError::kBadLength);
  CHECK(error_of(peek_header(with(good, 32, std::uint32_t{1}))) == BatchError::kBadLength);
  CHECK(error_of(peek_header(with(good, 36, std::uint32_t{199}))) == BatchError::kBadLength);
  // 2^31 · 102 ≡ 0 (mod 2^32): in 32 bits (2^31 + 2) · 102 would look like 2 · 102.
  CHECK(error_of(peek_header(with(good, 28, std::uint32_t{(1u << 31) + 2}))) ==
        BatchError::kBadLength);
  CHECK(to_string(BatchError::kBadLength) == "bad length");
}

TEST_CASE("a batch of another type than expected is refused by every decoder") {
  Random random(3);
  const std::vector<Bytes> messages = one_of_each(random);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    INFO("message " << i);
    // fuzz_batch aborts when two decoders accept the same bytes.
    CHECK(fuzz_batch(messages[i]));
  }
  std::uint64_t granted = 0;
  CHECK(error_of(decode_link_credit(messages[0], kLimits, granted)) == BatchError::kBadType);
}

TEST_CASE("a message beyond its largest size is refused before its records are read") {
  const std::size_t rays = kMaxRaysPerBatch + 1;
  Bytes bytes(ray_batch_bytes(rays));
  const Bytes head = encode_signal(kStamp, BatchType::kGreeting);
  std::memcpy(bytes.data(), head.data(), head.size());
  bytes = with(with(with(bytes, 6, std::uint8_t{1}), 28, static_cast<std::uint32_t>(rays)), 36,
               static_cast<std::uint32_t>(rays * kRayBytes));
  CHECK(error_of(decode_rays_of(bytes)) == BatchError::kTooLarge);
  Random random(4);
  CHECK(decode_rays_of(encode_rays(kStamp, some_rays(random, kMaxRaysPerBatch))).index() == 0);
}

TEST_CASE("rays with values that no ray can have are refused") {
  Random random(5);
  auto good = some_rays(random, 2);
  REQUIRE(decode_rays_of(encode_rays(kStamp, good)).index() == 0);
  using Change = std::function<void(RayTask&)>;
  const std::pair<const char*, Change> changes[] = {
      {"origin is NaN", [](RayTask& r) { r.ray.origin.y = kNan; }},
      {"origin is infinite", [](RayTask& r) { r.ray.origin.z = -kInf; }},
      {"direction is NaN", [](RayTask& r) { r.ray.direction.x = kNan; }},
      {"direction is infinite", [](RayTask& r) { r.ray.direction.x = kInf; }},
      {"direction is zero", [](RayTask& r) { r.ray.direction = {}; }},
      {"direction is too long", [](RayTask& r) { r.ray.direction = 1.001 * r.ray.direction; }},
      {"t is NaN", [](RayTask& r) { r.t = kNan; }},
      {"t is negative", [](RayTask& r) { r.t = -1e-300; }},
      {"t is infinite", [](RayTask& r) { r.t = kInf; }},
      {"t_max is NaN", [](RayTask& r) { r.t_max = kNan; }},
      {"t_max is negative", [](RayTask& r) { r.t_max = -1; }},
      {"weight is NaN", [](RayTask& r) { r.weight.r = kNan; }},
      {"weight is infinite", [](RayTask& r) { r.weight.g = kInf; }},
      {"weight is negative", [](RayTask& r) { r.weight.b = -1e-9; }},
      {"pixel is outside the picture", [](RayTask& r) { r.pixel = 4096; }},
      {"kind is unknown", [](RayTask& r) { r.kind = static_cast<RayKind>(4); }},
      {"a mirrored ray has a horizon",
       [](RayTask& r) {
         r.kind = RayKind::kReflection;
         r.ends_at_horizon = true;
       }},
      {"depth is beyond the job's", [](RayTask& r) { r.depth = 10; }},
      {"there is no such light",
       [](RayTask& r) {
         r.kind = RayKind::kShadow;
         r.light_or_medium = 64;
       }},
      {"column is outside the grid", [](RayTask& r) { r.region.column = 4; }},
      {"row is outside the grid", [](RayTask& r) { r.region.row = 2; }},
  };
  for (const auto& [name, change] : changes) {
    INFO(name);
    auto bad = good;
    change(bad[1]);
    std::vector<RayTask> rays(5);
    CHECK(error_of(decode_rays(encode_rays(kStamp, bad), kLimits, rays)) == BatchError::kBadValue);
    CHECK(rays.empty());
  }
  BatchLimits narrow = kLimits;
  narrow.max_exponent = 100;
  good[0].credit_exponent = 101;
  std::vector<RayTask> rays;
  CHECK(error_of(decode_rays(encode_rays(kStamp, good), narrow, rays)) == BatchError::kBadValue);
  narrow = kLimits;
  narrow.media = 2;
  good = some_rays(random, 2);
  for (RayTask& ray : good) {
    ray.kind = RayKind::kRefraction;
    ray.ends_at_horizon = false;
    ray.light_or_medium = 2;
  }
  CHECK(decode_rays(encode_rays(kStamp, good), narrow, rays).index() == 0);
  good[1].light_or_medium = 3;
  CHECK(error_of(decode_rays(encode_rays(kStamp, good), narrow, rays)) == BatchError::kBadValue);
  narrow = kLimits;
  narrow.max_hops = 120;
  good = some_rays(random, 2);
  for (RayTask& ray : good) ray.hops = 120;
  CHECK(decode_rays(encode_rays(kStamp, good), narrow, rays).index() == 0);
  ++good[1].hops;
  CHECK(error_of(decode_rays(encode_rays(kStamp, good), narrow, rays)) == BatchError::kBadValue);
}

TEST_CASE("contributions with values that nobody can have made are refused") {
  const auto decode_one = [](const TileCredit& credit, const Contribution& light) {
    std::vector<TileCredit> credits;
    std::vector<Contribution> contributions;
    return decode_contributions(
        encode_contributions(kStamp, std::span(&credit, 1), std::span(&light, 1)), kLimits, credits,
        contributions);
  };
  constexpr std::int64_t kMost = std::int64_t{1} << 62;
  CHECK(decode_one({63, Credit::from_words({1, 0, 0, 0, 2})}, {4095, {0, kMost, 1}}).index() == 0);
  CHECK(error_of(decode_one({64, {}}, {})) == BatchError::kBadValue);
  CHECK(error_of(decode_one({0, Credit::from_words({1ull << 39, 0, 0, 0, 0})}, {})) ==
        BatchError::kBadValue);
  CHECK(error_of(decode_one({0, Credit::from_words({0, 0, 0, 0, 1})}, {})) ==
        BatchError::kBadValue);
  CHECK(error_of(decode_one({}, {4096, {}})) == BatchError::kBadValue);
  CHECK(error_of(decode_one({}, {0, {-1, 0, 0}})) == BatchError::kBadValue);
  CHECK(error_of(decode_one({}, {0, {0, 0, kMost + 1}})) == BatchError::kBadValue);
}

TEST_CASE("grants, tokens and assignments with values out of range are refused") {
  std::uint64_t granted = 5;
  CHECK(error_of(decode_link_credit(encode_link_credit(kStamp, kMaxLinkCreditBytes + 1), kLimits,
                                    granted)) == BatchError::kBadValue);
  CHECK(granted == 5);
  Token token;
  CHECK(error_of(decode_token(with(encode_token(kStamp, {}), 44, std::uint8_t{2}), kLimits,
                              token)) == BatchError::kBadValue);
  std::vector<std::uint32_t> tiles(3);
  CHECK(error_of(decode_assignment(encode_assignment(kStamp, std::vector<std::uint32_t>{1, 64}),
                                   kLimits, tiles)) == BatchError::kBadValue);
  CHECK(tiles.empty());
  BatchLimits few_hops = kLimits;
  few_hops.max_hops = 12;
  std::vector<std::uint16_t> classes;
  CHECK(error_of(decode_class_credit(
            encode_class_credit(kStamp, std::vector<std::uint16_t>{12, 13}), few_hops, classes)) ==
        BatchError::kBadValue);
  CHECK(classes.empty());
  CHECK(decode_class_credit(encode_class_credit(kStamp, std::vector<std::uint16_t>{0, 12}),
                            few_hops, classes)
            .index() == 0);
  CHECK(classes == std::vector<std::uint16_t>{0, 12});
}

TEST_CASE("a batch cut anywhere, or with a byte too many, is refused") {
  Random random(6);
  for (Bytes bytes : one_of_each(random)) {
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      CHECK_FALSE(fuzz_batch(std::span(bytes).first(size)));
    }
    bytes.push_back(std::byte{0});
    CHECK_FALSE(fuzz_batch(bytes));
  }
}

TEST_CASE("mutated batches are refused or survive a round trip") {
  int accepted = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    for (const Bytes& bytes : one_of_each(random)) {
      accepted += fuzz_batch(test::mutated(bytes, random)) ? 1 : 0;
    }
  }
  // Many flips hit a weight or a stamp and leave a batch valid; else the test would prove little.
  CHECK(accepted > 1000);
}

TEST_CASE("control text is not taken for a batch") {
  const char text[] = "{\"graycube\":1}";
  CHECK_FALSE(looks_like_batch(std::as_bytes(std::span(text))));
  CHECK(looks_like_batch(encode_signal(kStamp, BatchType::kGreeting)));
  CHECK_FALSE(looks_like_batch({}));
}
