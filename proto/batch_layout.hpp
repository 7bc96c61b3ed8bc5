// What the writer and the reader of batches share: how counts decide a message's size.
#pragma once

#include <cstddef>
#include <cstdint>

#include "proto/batch.hpp"

namespace graycube::batch_layout {

struct PayloadRule {
  /// False when no batch of the type may have these counts.
  bool counts_fit;
  /// What the payload must measure; multiplied in 64 bits, so nothing wraps.
  std::uint64_t bytes;
};

inline PayloadRule payload_rule(const BatchHeader& h) {
  const std::uint64_t count = h.count, second = h.second_count;
  const bool single = second == 0;
  switch (h.type) {
    case BatchType::kRays:
    case BatchType::kClassRays: return {single, count * kRayBytes};
    case BatchType::kContributions:
      return {true, count * kTileCreditBytes + second * kContributionBytes};
    case BatchType::kLinkCredit: return {single && count == 1, 8};
    case BatchType::kToken: return {single && count == 1, kTokenBytes};
    case BatchType::kAssignment: return {single, count * 4};
    case BatchType::kClassCredit: return {single, count * 2};
    case BatchType::kGreeting:
    case BatchType::kGreetingAck:
    case BatchType::kGoodbye:
    case BatchType::kGoodbyeAck:
    case BatchType::kIdle:
    case BatchType::kIdleWithCopy: return {single && count == 0, 0};
  }
  return {false, 0};
}

/// Beside a ray's kind: RayTask::ends_at_horizon.
inline constexpr std::uint8_t kHorizonFlag = 4;

constexpr std::size_t max_message_bytes(BatchType type) {
  return type == BatchType::kContributions ? kMaxContributionBatchBytes : kMaxBatchBytes;
}

constexpr bool is_signal(BatchType type) {
  return type == BatchType::kGreeting || type == BatchType::kGreetingAck ||
         type == BatchType::kGoodbye || type == BatchType::kGoodbyeAck ||
         type == BatchType::kIdle || type == BatchType::kIdleWithCopy;
}

}  // namespace graycube::batch_layout
