// Batches for tests: random records within limits, and one message of every type.
#pragma once

#include <cstring>
#include <vector>

#include "catch.hpp"
#include "geometry/infinity.hpp"
#include "proto/batch.hpp"
#include "proto/bytes.hpp"
#include "proto/random.hpp"

namespace graycube::test {

using Bytes = std::vector<std::byte>;

inline constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
// The same limits as in fuzz_batch, so that the mutation tests start from accepted messages.
inline constexpr BatchLimits kLimits{
    .pixel_count = 4096, .tile_count = 64, .max_depth = 9, .columns = 4, .rows = 2, .nodes = 8};
inline constexpr BatchStamp kStamp{
    .job = 3, .epoch = 2, .sender = 5, .incarnation = 77, .sequence = 1ull << 40};

inline RayTask some_ray(Random& random) {
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
  const bool is_shadow = task.kind == RayKind::kShadow;
  task.light_or_medium =
      static_cast<std::uint16_t>(random.below(is_shadow ? kMaxCreditLights : kMaxMedia + 1) & 0xFF);
  task.region = {static_cast<std::uint16_t>(random.below(4)),
                 static_cast<std::uint16_t>(random.below(2)),
                 static_cast<std::uint16_t>(random.below(kMaxSlabs))};
  task.hops = static_cast<std::uint16_t>(random.below(kMaxHops + 1));
  return task;
}

inline std::vector<RayTask> some_rays(Random& random, std::size_t count) {
  std::vector<RayTask> rays;
  for (std::size_t i = 0; i < count; ++i) rays.push_back(some_ray(random));
  return rays;
}

inline TileCredit some_credit(Random& random) {
  TileCredit c{static_cast<std::uint32_t>(random.below(64)), {}};
  for (int i = 0; i < 20; ++i) c.credit.add_power(static_cast<int>(random.below(256)));
  return c;
}

inline Contribution some_light(Random& random) {
  const auto value = [&] { return static_cast<std::int64_t>(random.below((1ull << 62) + 1)); };
  return {static_cast<std::uint32_t>(random.below(4096)), {value(), value(), value()}};
}

/// Light, dim or bright, of pixels apart and side by side.
inline std::vector<Contribution> some_lights(Random& random, std::size_t count) {
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

/// The bytes of a part of a slice.
inline const Bytes kSomeBytes(9, std::byte{0x5a});

/// One message of every type.
inline std::vector<Bytes> one_of_each(Random& random) {
  std::vector<TileCredit> credits;
  std::vector<Contribution> light;
  for (int i = 0; i < 3; ++i) credits.push_back(some_credit(random));
  light = some_lights(random, 4);
  return {encode_rays(kStamp, some_rays(random, 3)),
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
                                                        {1u << 31, true, {kMaxMergedLight, 1, 1}}}),
          encode_slice_part(kStamp, {7, 5, 300, kSomeBytes})};
}

template <class T>
Bytes with(Bytes bytes, std::size_t offset, T value) {
  store_little(bytes.data() + offset, value);
  return bytes;
}

inline BatchError error_of(const BatchResult& result) {
  REQUIRE(std::holds_alternative<BatchError>(result));
  return std::get<BatchError>(result);
}

inline BatchResult decode_rays_of(const Bytes& bytes) {
  std::vector<RayTask> rays;
  return decode_rays(bytes, kLimits, rays);
}

}  // namespace graycube::test
