#include "proto/batch.hpp"
#include "geometry/infinity.hpp"

#include <array>
#include <cstring>
#include <functional>

#include "catch.hpp"
#include "fuzz/proto_fuzz.hpp"
#include "proto/bytes.hpp"
#include "proto/random.hpp"

using namespace graycube;
using graycube::test::Random;

namespace {

using Bytes = std::vector<std::byte>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// The same limits as in fuzz_batch, so that the mutation tests start from accepted messages.
constexpr BatchLimits kLimits{
    .pixel_count = 4096, .tile_count = 64, .max_depth = 9, .columns = 4, .rows = 2, .nodes = 8};
constexpr BatchStamp kStamp{
    .job = 3, .epoch = 2, .sender = 5, .incarnation = 77, .sequence = 1ull << 40};

RayTask some_ray(Random& random) {
  RayTask task;
  task.ray = {random.vec(), random.unit()};
  task.t = random.not_negative();
  task.t_max = random.chance(2) ? kInf : random.not_negative();
  task.weight = random.rgb();
  task.pixel = static_cast<std::uint32_t>(random.below(4096));
  task.kind = static_cast<RayKind>(random.below(kRayKinds));
  task.ends_at_horizon = task.kind == RayKind::kShadow && random.chance(2);
  task.credit_exponent = static_cast<std::uint8_t>(random.below(256));
  task.depth = static_cast<std::uint16_t>(random.below(10));
  task.light = static_cast<std::uint16_t>(random.below(64) & 63);
  task.region = {static_cast<std::uint16_t>(random.below(4)),
                 static_cast<std::uint16_t>(random.below(2))};
  task.hops = static_cast<std::uint16_t>(random.below(kMaxHops + 1));
  return task;
}

std::vector<RayTask> some_rays(Random& random, std::size_t count) {
  std::vector<RayTask> rays;
  for (std::size_t i = 0; i < count; ++i) rays.push_back(some_ray(random));
  return rays;
}

TileCredit some_credit(Random& random) {
  TileCredit c{static_cast<std::uint32_t>(random.below(64)), {}};
  for (int i = 0; i < 20; ++i) c.credit.add_power(static_cast<int>(random.below(256)));
  return c;
}

Contribution some_light(Random& random) {
  const auto value = [&] { return static_cast<std::int64_t>(random.below((1ull << 62) + 1)); };
  return {static_cast<std::uint32_t>(random.below(4096)), {value(), value(), value()}};
}

/// Light, dim or bright, of pixels apart and side by side.
std::vector<Contribution> some_lights(Random& random, std::size_t count) {
  std::vector<Contribution> all;
  while (all.size() < count) {
    Contribution c = some_light(random);
    const auto bits = random.below(63);
    for (std::int64_t* v : {&c.light.r, &c.light.g, &c.light.b})
      *v &= (std::int64_t{1} << bits) - 1;
    if (!all.empty() && !random.chance(3)) c.pixel = (all.back().pixel + 1) % 4096;
    all.push_back(c);
  }
  return all;
}

/// One message of every type.
std::vector<Bytes> one_of_each(Random& random) {
  std::vector<TileCredit> credits;
  std::vector<Contribution> light;
  for (int i = 0; i < 3; ++i) credits.push_back(some_credit(random));
  light = some_lights(random, 4);
  return {
      encode_rays(kStamp, some_rays(random, 3)),
      encode_contributions(kStamp, credits, light),
      encode_link_credit(kStamp, 65536),
      encode_token(kStamp, {true, -12, 3, 20, 99}),
      encode_assignment(kStamp, std::vector<std::uint32_t>{0, 7, 63}),
      encode_signal(kStamp, BatchType::kGreeting),
      encode_signal(kStamp, BatchType::kGreetingAck),
      encode_signal(kStamp, BatchType::kGoodbye),
      encode_signal(kStamp, BatchType::kGoodbyeAck),
      encode_offer(kStamp, BatchType::kIdle, 1ull << 40),
      encode_offer(kStamp, BatchType::kIdleWithCopy, 0),
      encode_rays(kStamp, some_rays(random, 2), BatchType::kClassRays),
      encode_class_credit(kStamp, std::vector<std::uint16_t>{0, 3, 0xFFFF}),
      encode_answers(kStamp, std::vector<RayAnswer>{{5, false, {1, 0, 300}},
                                                    {6, true, {}},
                                                    {1u << 31, true, {kMaxMergedLight, 1, 1}}})};
}

template <class T>
Bytes with(Bytes bytes, std::size_t offset, T value) {
  store_little(bytes.data() + offset, value);
  return bytes;
}

BatchError error_of(const BatchResult& result) {
  REQUIRE(std::holds_alternative<BatchError>(result));
  return std::get<BatchError>(result);
}

BatchResult decode_rays_of(const Bytes& bytes) {
  std::vector<RayTask> rays;
  return decode_rays(bytes, kLimits, rays);
}

}  // namespace

TEST_CASE("a batch's header lies at the offsets that FORMAT.md gives") {
  Random random(1);
  const Bytes bytes = encode_rays(kStamp, some_rays(random, 2));
  REQUIRE(bytes.size() == 44 + 2 * 102);
  CHECK(std::memcmp(bytes.data(), "GCB1", 4) == 0);
  CHECK(load_little<std::uint16_t>(bytes.data() + 4) == 2);
  CHECK(load_little<std::uint8_t>(bytes.data() + 6) == 1);
  CHECK(load_little<std::uint8_t>(bytes.data() + 7) == 0);
  CHECK(load_little<std::uint32_t>(bytes.data() + 8) == 3);
  CHECK(load_little<std::uint32_t>(bytes.data() + 12) == 2);
  CHECK(load_little<std::uint32_t>(bytes.data() + 16) == 5);
  CHECK(load_little<std::uint64_t>(bytes.data() + 20) == 1ull << 40);
  CHECK(load_little<std::uint32_t>(bytes.data() + 28) == 2);
  CHECK(load_little<std::uint32_t>(bytes.data() + 32) == 0);
  CHECK(load_little<std::uint32_t>(bytes.data() + 36) == 204);
  CHECK(load_little<std::uint32_t>(bytes.data() + 40) == 77);
}

TEST_CASE("a ray lies at the offsets that FORMAT.md gives") {
  RayTask task;
  task.ray = {{1, 2, 3}, {0, 0.6, 0.8}};
  task.t = 4;
  task.t_max = 5;
  task.weight = {0.25, 0.5, 0.75};
  task.pixel = 0x01020304;
  task.kind = RayKind::kReflection;
  task.credit_exponent = 130;
  task.depth = 0x05;
  task.light = 0x06;
  task.region = {0x0708, 0x090A};
  task.hops = 0x0B0C;
  const Bytes bytes = encode_rays(kStamp, std::span(&task, 1));
  const std::byte* at = bytes.data() + 44;
  const double expected[] = {1, 2, 3, 0, 0.6, 0.8, 4, 5, 0.25, 0.5, 0.75};
  for (std::size_t i = 0; i < std::size(expected); ++i)
    CHECK(load_little<double>(at + 8 * i) == expected[i]);
  CHECK(load_little<std::uint32_t>(at + 88) == 0x01020304);
  CHECK(load_little<std::uint8_t>(at + 92) == 2);
  CHECK(load_little<std::uint8_t>(at + 93) == 130);
  CHECK(load_little<std::uint16_t>(at + 94) == 0x0605);
  CHECK(load_little<std::uint16_t>(at + 96) == 0x0708);
  task.kind = RayKind::kShadow;
  task.ends_at_horizon = true;
  CHECK(load_little<std::uint8_t>(encode_rays(kStamp, std::span(&task, 1)).data() + 44 + 92) == 5);
  CHECK(load_little<std::uint16_t>(at + 98) == 0x090A);
  CHECK(load_little<std::uint16_t>(at + 100) == 0x0B0C);
}

TEST_CASE("a ray's generation of the grid is a bit beside its kind, where boundaries slide") {
  Random random(5);
  std::vector<RayTask> rays = some_rays(random, 20);
  for (std::size_t i = 0; i < rays.size(); ++i) rays[i].generation = i % 2 != 0;
  const Bytes bytes = encode_rays(kStamp, rays);
  BatchLimits limits = kLimits;
  std::vector<RayTask> again;
  CHECK(std::get<BatchError>(decode_rays(bytes, limits, again)) == BatchError::kBadValue);
  limits.may_slide = true;
  REQUIRE(std::holds_alternative<BatchHeader>(decode_rays(bytes, limits, again)));
  CHECK(again == rays);
  CHECK(load_little<std::uint8_t>(bytes.data() + 44 + kRayBytes + 92) >= 8);
}

TEST_CASE("rays keep every bit on the wire") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    const auto rays = some_rays(random, random.below(40));
    std::vector<RayTask> again(7);
    const BatchResult result = decode_rays(encode_rays(kStamp, rays), kLimits, again);
    REQUIRE(std::holds_alternative<BatchHeader>(result));
    CHECK(std::get<BatchHeader>(result).stamp == kStamp);
    CHECK(std::get<BatchHeader>(result).count == rays.size());
    REQUIRE(again.size() == rays.size());
    // No padding before the last field: memcmp compares all bits.
    constexpr std::size_t kSize = offsetof(RayTask, hops) + sizeof(RayTask::hops);
    // Depth and light take a byte less each on the wire.
    static_assert(kSize == kRayBytes + 2);
    for (std::size_t i = 0; i < rays.size(); ++i)
      CHECK(std::memcmp(&again[i], &rays[i], kSize) == 0);
  }
}

TEST_CASE("contributions and their credit come back as sent") {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    std::vector<TileCredit> credits, credits_again;
    std::vector<Contribution> light, light_again;
    for (std::uint64_t n = random.below(9); n > 0; --n) credits.push_back(some_credit(random));
    light = some_lights(random, seed % 10 == 0 ? 1000 : random.below(9));
    const Bytes bytes = encode_contributions(kStamp, credits, light);
    CHECK(bytes.size() <= most_contribution_bytes(credits.size(), light.size()));
    const BatchResult result = decode_contributions(bytes, kLimits, credits_again, light_again);
    REQUIRE(std::holds_alternative<BatchHeader>(result));
    CHECK(credits_again == credits);
    CHECK(light_again == light);
  }
}

TEST_CASE("light lies in runs as FORMAT.md gives them") {
  const std::vector<Contribution> light{
      {0x0102, {1, 0x0304, 0}}, {0x0103, {5, 6, 7}}, {0x0200, {0, 0, 0}}};
  const Bytes bytes = encode_contributions(kStamp, {}, light);
  const auto expected =
      std::to_array<std::uint8_t>({0x02, 0x01, 0, 0, 2,    2,    1, 0, 4, 3, 0, 0, 5, 0,
                                   6,    0,    7, 0, 0x00, 0x02, 0, 0, 1, 1, 0, 0, 0});
  REQUIRE(bytes.size() == 44 + expected.size());
  CHECK(load_little<std::uint32_t>(bytes.data() + 32) == 3);
  CHECK(load_little<std::uint32_t>(bytes.data() + 36) == expected.size());
  CHECK(std::memcmp(bytes.data() + 44, expected.data(), expected.size()) == 0);
}

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

TEST_CASE("grants, tokens, assignments and signals come back as sent") {
  std::uint64_t granted = 0;
  REQUIRE(decode_link_credit(encode_link_credit(kStamp, 123456), kLimits, granted).index() == 0);
  CHECK(granted == 123456);
  for (const auto type : {BatchType::kIdle, BatchType::kIdleWithCopy}) {
    std::uint64_t work = 0;
    const BatchResult result = decode_offer(encode_offer(kStamp, type, 1ull << 50), kLimits, work);
    REQUIRE(std::holds_alternative<BatchHeader>(result));
    CHECK(std::get<BatchHeader>(result).type == type);
    CHECK(work == 1ull << 50);
  }
  CHECK(std::holds_alternative<BatchError>(
      decode_offer(encode_signal(kStamp, BatchType::kGreeting), kLimits, granted)));
  Token token;
  const Token sent{true, -5'000'000'000, 17, 300, 1ull << 33};
  REQUIRE(decode_token(encode_token(kStamp, sent), kLimits, token).index() == 0);
  CHECK(token == sent);
  const std::vector<std::uint32_t> tiles{63, 0, 5};
  std::vector<std::uint32_t> tiles_again;
  REQUIRE(decode_assignment(encode_assignment(kStamp, tiles), kLimits, tiles_again).index() == 0);
  CHECK(tiles_again == tiles);
  for (const auto type : {BatchType::kGreeting, BatchType::kGreetingAck, BatchType::kGoodbye,
                          BatchType::kGoodbyeAck}) {
    const BatchResult result = peek_header(encode_signal(kStamp, type));
    REQUIRE(std::holds_alternative<BatchHeader>(result));
    CHECK(std::get<BatchHeader>(result).type == type);
  }
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
  CHECK(error_of(peek_header(with(good, 4, std::uint16_t{3}))) == BatchError::kBadVersion);
  CHECK(error_of(peek_header(with(good, 6, std::uint8_t{0}))) == BatchError::kBadType);
  CHECK(error_of(peek_header(with(good, 6, std::uint8_t{15}))) == BatchError::kBadType);
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
      {"there is no such light", [](RayTask& r) { r.light = 64; }},
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
