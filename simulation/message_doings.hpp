// The work that messages cause, in units.
#pragma once

#include <cstddef>
#include <variant>
#include <vector>

#include "node/node.hpp"
#include "node/parts/fifo/fifo_words.hpp"
#include "proto/batch.hpp"
#include "simulation/doings.hpp"

namespace graycube::simulation {

inline std::size_t bytes_of(const Message& m) { return m.frame.size() + m.payload.size(); }

/// One side's part of passing on a message of so many bytes.
inline PerUnit handling(std::size_t bytes, bool is_ciphered = false) {
  PerUnit doings;
  doings[Unit::kMessage] = 1;
  doings[Unit::kMessageByte] = static_cast<double>(bytes);
  doings[Unit::kCipherByte] = is_ciphered ? static_cast<double>(bytes) : 0;
  return doings;
}

/// A node's brain's work when it receives a message.
inline PerUnit receiving(const Message& message) {
  PerUnit doings;
  doings[Unit::kNodeCall] = 1;
  const auto header = peek_header(message.frame);
  const auto* h = std::get_if<BatchHeader>(&header);
  if (h == nullptr) return doings;
  if (h->type == BatchType::kRays) doings[Unit::kRayIn] = h->count;
  if (h->type == BatchType::kContributions || h->type == BatchType::kAnswers) {
    doings[Unit::kFrontalByte] = static_cast<double>(message.frame.size());
  }
  return doings;
}

/// Adds the work of making these messages to `doings`.
inline void add_sending(const std::vector<Node::Outgoing>& messages, PerUnit& doings) {
  for (const Node::Outgoing& o : messages) {
    const auto header = peek_header(o.message.frame);
    const auto* h = std::get_if<BatchHeader>(&header);
    if (h == nullptr) continue;
    if (h->type == BatchType::kRays) doings[Unit::kRayOut] += h->count;
    if (h->type == BatchType::kContributions || h->type == BatchType::kAnswers) {
      doings[Unit::kLightByte] += static_cast<double>(o.message.frame.size());
    }
  }
}

/// The same for messages to the process that holds the node's FIFO, with one side's part of passing
/// them on.
inline void add_sending_to_fifo(const std::vector<Bytes>& messages, PerUnit& doings) {
  for (const Bytes& m : messages) {
    doings.add(handling(m.size()));
    if (m.front() == static_cast<std::byte>(FifoWord::kPut)) doings[Unit::kRayOut] += 1;
  }
}

}  // namespace graycube::simulation
