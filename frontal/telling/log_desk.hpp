// The last lines of a farm's log, for clients that ask for them, at once or when one comes.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

#include "frontal/parts/farm_log.hpp"
#include "frontal/parts/post.hpp"

namespace graycube {

/// Requests that may wait for a line. When another one comes, the oldest is answered without.
inline constexpr std::size_t kMaxLogWaits = 64;

class LogDesk {
 public:
  /// `pid`: the frontal's process, which numbers the lines.
  explicit LogDesk(std::uint64_t pid) : pid_(pid) {}

  void add(const FarmEvent& event);
  /// The farm goes down: answers tell that no further lines come.
  void end() { is_end_ = true; }
  /// Answers a request, now or later.
  void ask(const PeerId& peer, const control::Log& request, double now_s, Post& post);
  /// Answers those that waited for lines which are there now, or for too long.
  void answer_waits(double now_s, Post& post);

 private:
  struct Wait {
    PeerId peer;
    control::Log request;
    double until_s = 0;
  };
  control::LogLines answer_to(const control::Log& request) const;

  std::uint64_t pid_;
  std::uint64_t last_number_ = 0;
  bool is_end_ = false;
  std::deque<control::LogLine> lines_;
  std::deque<Wait> waits_;
};

}  // namespace graycube
