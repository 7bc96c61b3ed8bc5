// Batches: where everything lies, and that it comes back as sent.
#include "proto/batch.hpp"

#include <array>
#include <cstring>

#include "catch.hpp"
#include "proto/batch_samples.hpp"
#include "proto/bytes.hpp"
#include "proto/random.hpp"

using namespace graycube;
using namespace graycube::test;

TEST_CASE("a batch's header lies at the offsets that FORMAT.md gives") {
  Random random(1);
  const Bytes bytes = encode_rays(kStamp, some_rays(random, 2));
  REQUIRE(bytes.size() == 44 + 2 * 102);
  CHECK(std::memcmp(bytes.data(), "GCB1", 4) == 0);
  CHECK(load_little<std::uint16_t>(bytes.data() + 4) == 3);
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
  task.light_or_medium = 0x06;
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
  task.region.slab = 5;
  CHECK(load_little<std::uint16_t>(encode_rays(kStamp, std::span(&task, 1)).data() + 44 + 98) ==
        0x590A);
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
    // Depth and light take a byte less each on the wire, and a slab shares two with its row.
    static_assert(kSize == kRayBytes + 4);
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
