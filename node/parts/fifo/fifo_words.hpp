// What a node and the process that holds its FIFO say to each other, in a stream of bytes.
//
//   node → FIFO   put    a ray that a neighbour sent
//                 ask    for the oldest ray, as soon as there is one
//   FIFO → node   hand   that ray
//
// A message is the byte of its word. Behind that of `put` and `hand` comes a ray, as a batch of one
// (proto/batch.hpp); the FIFO doesn't look into it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "proto/batch.hpp"
#include "transport/message.hpp"

namespace graycube {

enum class FifoWord : std::uint8_t { kPut = 1, kAsk = 2, kHand = 3 };

/// Bytes of a ray in a FIFO.
inline constexpr std::size_t kFifoRayBytes = kBatchHeaderBytes + kRayBytes;
inline constexpr std::size_t kMostFifoMessageBytes = 1 + kFifoRayBytes;

/// `ray` has kFifoRayBytes, and is empty behind `ask`.
inline Bytes fifo_message(FifoWord word, std::span<const std::byte> ray = {}) {
  Bytes message(1 + ray.size());
  message.front() = static_cast<std::byte>(word);
  std::ranges::copy(ray, message.begin() + 1);
  return message;
}

/// Bytes of a message that begins with this one; 0 if none does.
constexpr std::size_t fifo_message_bytes(std::byte first) {
  switch (static_cast<FifoWord>(first)) {
    case FifoWord::kPut:
    case FifoWord::kHand: return kMostFifoMessageBytes;
    case FifoWord::kAsk: return 1;
  }
  return 0;
}

/// Cuts a stream into messages, in whatever parts it arrives.
class FifoStream {
 public:
  /// Calls visit(word, ray) for each message that is complete now. False when the bytes are none of
  /// the messages above: the stream is of no use from there on.
  template <typename Visit>
  [[nodiscard]] bool take(std::span<const std::byte> bytes, Visit&& visit) {
    while (!bytes.empty()) {
      const std::size_t wanted = fifo_message_bytes(kept_ > 0 ? part_[0] : bytes[0]);
      if (wanted == 0) return false;
      const std::size_t count = std::min(wanted - kept_, bytes.size());
      std::memcpy(part_.data() + kept_, bytes.data(), count);
      bytes = bytes.subspan(count);
      kept_ += count;
      if (kept_ < wanted) return true;
      kept_ = 0;
      visit(static_cast<FifoWord>(part_[0]),
            std::span<const std::byte>(part_.data() + 1, wanted - 1));
    }
    return true;
  }

 private:
  /// The beginning of a message whose rest has yet to come.
  std::array<std::byte, kMostFifoMessageBytes> part_{};
  std::size_t kept_ = 0;
};

}  // namespace graycube
