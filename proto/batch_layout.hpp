// How counts decide a message's size, for the writer and the reader of batches.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "proto/batch.hpp"

namespace graycube::batch_layout {

struct PayloadRule {
  /// False when no batch of the type may have these counts.
  bool counts_fit;
  /// Bytes that the payload must have; multiplied in 64 bits, so nothing wraps.
  std::uint64_t bytes;
  /// Bytes that it may have beyond that, depending on the records.
  std::uint64_t more = 0;
};

/// Light comes in runs of pixels side by side, with each component in as many bytes as the largest
/// component needs.
inline constexpr std::size_t kRunHeaderBytes = 6, kMaxRunPixels = 255;
inline constexpr std::size_t kLeastPixelBytes = 3;
static_assert(kMostPixelBytes == kRunHeaderBytes + 3 * sizeof(std::uint64_t));

/// How many bytes a component takes in a run, where `bits` is all of its components' or-ed.
constexpr std::size_t component_bytes(std::uint64_t bits) {
  return std::max<std::size_t>(1, (static_cast<std::size_t>(std::bit_width(bits)) + 7) / 8);
}

constexpr std::uint64_t bits_of(const FixedRgb& light) {
  return static_cast<std::uint64_t>(light.r | light.g | light.b);
}

/// Calls visit with `bytes`, which is 1 to 8, as a constant.
template <class Visit>
void with_component_bytes(std::size_t bytes, Visit&& visit) {
  switch (bytes) {
    case 1: return visit(std::integral_constant<std::size_t, 1>());
    case 2: return visit(std::integral_constant<std::size_t, 2>());
    case 3: return visit(std::integral_constant<std::size_t, 3>());
    case 4: return visit(std::integral_constant<std::size_t, 4>());
    case 5: return visit(std::integral_constant<std::size_t, 5>());
    case 6: return visit(std::integral_constant<std::size_t, 6>());
    case 7: return visit(std::integral_constant<std::size_t, 7>());
    default: return visit(std::integral_constant<std::size_t, 8>());
  }
}

inline PayloadRule payload_rule(const BatchHeader& h) {
  const std::uint64_t count = h.count, second = h.second_count;
  const bool single = second == 0;
  switch (h.type) {
    case BatchType::kRays:
    case BatchType::kClassRays: return {single, count * kRayBytes};
    case BatchType::kContributions:
      return {true, count * kTileCreditBytes + second * kLeastPixelBytes,
              second * (kMostPixelBytes - kLeastPixelBytes)};
    case BatchType::kLinkCredit: return {single && count == 1, 8};
    case BatchType::kToken: return {single && count == 1, kTokenBytes};
    case BatchType::kAssignment: return {single, count * 4};
    case BatchType::kClassCredit: return {single, count * 2};
    case BatchType::kAnswers:
      return {single, count * kLeastAnswerBytes, count * (kMostAnswerBytes - kLeastAnswerBytes)};
    case BatchType::kGreeting:
    case BatchType::kGreetingAck:
    case BatchType::kGoodbye:
    case BatchType::kGoodbyeAck: return {single && count == 0, 0};
    case BatchType::kIdle:
    case BatchType::kIdleWithCopy: return {single && count == 1, 8};
  }
  return {false, 0};
}

/// A bit beside the ray's kind that says RayTask::ends_at_horizon.
inline constexpr std::uint8_t kHorizonFlag = 4;
/// A bit beside them that says RayTask::generation.
inline constexpr std::uint8_t kGenerationFlag = 8;
/// A bit beside the bytes of a component that says that more answers to the same ray follow.
inline constexpr std::uint8_t kMoreFlag = 16;

constexpr std::size_t max_message_bytes(BatchType type) {
  return type == BatchType::kContributions ? kMaxContributionBatchBytes : kMaxBatchBytes;
}

constexpr bool is_signal(BatchType type) {
  return type == BatchType::kGreeting || type == BatchType::kGreetingAck ||
         type == BatchType::kGoodbye || type == BatchType::kGoodbyeAck;
}

constexpr bool is_offer(BatchType type) {
  return type == BatchType::kIdle || type == BatchType::kIdleWithCopy;
}

}  // namespace graycube::batch_layout
