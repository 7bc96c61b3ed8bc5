// Batches of answers: light on its way back along the rays' ways.
#include <vector>

#include "catch.hpp"
#include "proto/batch.hpp"
#include "proto/bytes.hpp"
#include "proto/random.hpp"

using namespace graycube;
using graycube::test::Random;

namespace {

constexpr BatchLimits kLimits{.nodes = 8};
constexpr BatchStamp kStamp{.job = 3, .epoch = 2, .sender = 5, .incarnation = 77, .sequence = 9};

std::vector<RayAnswer> decoded(const std::vector<std::byte>& batch) {
  std::vector<RayAnswer> answers;
  REQUIRE(decode_answers(batch, kLimits, answers).index() == 0);
  return answers;
}

/// Whether a batch is refused that has one answer, encoded as these bytes behind its number.
bool is_refused(std::vector<std::uint8_t> bytes) {
  std::vector<std::byte> batch = encode_answers(kStamp, std::vector<RayAnswer>{{7, true, {}}});
  batch.pop_back();
  for (const std::uint8_t b : bytes) batch.push_back(std::byte{b});
  store_little(batch.data() + 36, static_cast<std::uint32_t>(4 + bytes.size()));
  std::vector<RayAnswer> answers(3);
  const BatchResult result = decode_answers(batch, kLimits, answers);
  if (result.index() == 0) return false;
  CHECK(std::get<BatchError>(result) == BatchError::kBadValue);
  CHECK(answers.empty());
  return true;
}

}  // namespace

TEST_CASE("answers survive a round trip, and take no more bytes than their light needs") {
  Random random(1);
  std::vector<RayAnswer> all{{0, true, {}}, {0xFFFFFFFF, true, {kMaxMergedLight, 0, 1}}};
  for (int i = 0; i < 500; ++i) {
    const auto bits = random.below(63);
    const auto value = [&] {
      return static_cast<std::int64_t>(random.below((std::uint64_t{1} << bits) + 1));
    };
    RayAnswer a{
        static_cast<std::uint32_t>(random.below(1ull << 32)), true, {value(), value(), value()}};
    a.is_last = a.light == FixedRgb{} || random.chance(2);
    all.push_back(a);
  }
  CHECK(decoded(encode_answers(kStamp, all)) == all);
  const auto size = [](const FixedRgb& light) {
    return encode_answers(kStamp, std::vector<RayAnswer>{{1, true, light}}).size();
  };
  CHECK(size({}) == kBatchHeaderBytes + kLeastAnswerBytes);
  CHECK(size({255, 0, 0}) == kBatchHeaderBytes + 5 + 3);
  CHECK(size({0, 256, 0}) == kBatchHeaderBytes + 5 + 6);
  CHECK(size({0, 0, kMaxMergedLight}) == kBatchHeaderBytes + kMostAnswerBytes);
}

TEST_CASE("an answer lies at the offsets that FORMAT.md gives") {
  const auto bytes = encode_answers(kStamp, std::vector<RayAnswer>{{0x01020304, false, {5, 6, 7}}});
  REQUIRE(bytes.size() == 44 + 8);
  CHECK(load_little<std::uint8_t>(bytes.data() + 6) == 14);
  CHECK(load_little<std::uint32_t>(bytes.data() + 44) == 0x01020304);
  CHECK(load_little<std::uint8_t>(bytes.data() + 48) == 16 + 1);
  CHECK(load_little<std::uint8_t>(bytes.data() + 49) == 5);
  CHECK(load_little<std::uint8_t>(bytes.data() + 51) == 7);
}

TEST_CASE("an answer in another form, with too much light, or for nothing is refused") {
  CHECK_FALSE(is_refused({0}));
  CHECK_FALSE(is_refused({1, 0, 0, 9}));
  CHECK(is_refused({16}));                   // more follows, but there is no light
  CHECK(is_refused({1, 0, 0, 0}));           // no light takes no bytes
  CHECK(is_refused({2, 9, 0, 9, 0, 9, 0}));  // one byte each would do
  CHECK(is_refused({2, 9, 1, 9, 0}));        // cut
  CHECK(is_refused({1, 9, 9, 9, 0}));        // a byte too many
  CHECK(is_refused({9}));
  CHECK(is_refused({32}));
  std::vector<std::uint8_t> bright(25, 0);
  bright[0] = 8;
  bright[8] = 0x40;
  CHECK_FALSE(is_refused(bright));
  bright[1] = 1;
  CHECK(is_refused(bright));
}

TEST_CASE(
    "a ray may carry any number for its pixel where rays are numbered, unless it is primary") {
  RayTask ray;
  ray.ray.direction = {0, 0, 1};
  ray.pixel = 1 << 30;
  const auto is_taken = [&](RayKind kind, bool are_numbered) {
    ray.kind = kind;
    BatchLimits limits = kLimits;
    limits.pixel_count = 100;
    limits.are_rays_numbered = are_numbered;
    std::vector<RayTask> rays;
    return decode_rays(encode_rays(kStamp, {&ray, 1}), limits, rays).index() == 0;
  };
  CHECK(is_taken(RayKind::kReflection, true));
  CHECK(is_taken(RayKind::kShadow, true));
  CHECK_FALSE(is_taken(RayKind::kPrimary, true));
  CHECK_FALSE(is_taken(RayKind::kReflection, false));
}
