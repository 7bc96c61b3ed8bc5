// A node's end of a FIFO that a process apart holds, as on the machine of 1987: received rays go
// there, and come back one by one, in the order in which they were received.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "node/parts/mail.hpp"
#include "proto/messages.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

/// What a node needs a FIFO's process for: a new one for each epoch of a job.
struct FifoOrder {
  std::uint32_t job = 0, epoch = 0;
  /// The most rays that it holds.
  std::size_t places = 0;
  friend bool operator==(const FifoOrder&, const FifoOrder&) = default;
};

/// Rays that the queue of a node with so many links holds. A link has credit for its part of it.
inline std::size_t fifo_places(const control::Load& load, std::uint32_t links) {
  return links * static_cast<std::size_t>(load.link_credit_bytes / kRayBytes);
}

/// Whether the job's rays go through such a FIFO on a node with so many links.
inline bool is_fifo_apart(const control::Load& load, std::uint32_t links) {
  return load.algorithm == Algorithm::kMacro && load.flow == FlowMode::kBlocking &&
         load.fifo == FifoMode::kProcess && links > 0;
}

class FifoApart {
 public:
  /// A ray that was handed out, and the link across which it had come.
  struct Handed {
    std::uint32_t bit;
    RayTask ray;
  };

  FifoApart(std::uint32_t links, std::size_t places) : links_(links), places_(places) {}

  /// Rays came across a link. More than the queue has places for fail the job.
  void put(std::uint32_t bit, std::span<const RayTask> rays, Mail& mail);
  /// Asks for the oldest ray, unless there is none or it is on its way.
  void ask(Mail& mail);
  /// Takes the ray that is handed out. Nothing if it is of an earlier epoch, or not the one that is
  /// due: then the job has failed.
  std::optional<Handed> on_hand(std::span<const std::byte> ray, const BatchLimits& limits,
                                Mail& mail);
  /// Rays that were put in and have not come back.
  std::size_t held() const { return static_cast<std::size_t>(put_ - handed_); }
  void report(control::NodeStats& stats) const { stats.fifo_messages = messages_; }
  /// A new epoch, with a new process.
  void reset();

 private:
  std::uint32_t links_;
  std::size_t places_;
  /// Numbers of rays in this epoch.
  std::uint64_t put_ = 0, handed_ = 0;
  bool is_asked_ = false;
  std::uint64_t messages_ = 0;
  /// The ray that is taken in; a member so that its memory serves the next.
  std::vector<RayTask> came_;
};

}  // namespace graycube
