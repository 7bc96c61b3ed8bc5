// How often a frontal that dies is started again: a scene that kills each one mustn't do so
// forever.
#pragma once

#include <chrono>
#include <deque>

namespace graycube {

inline constexpr std::size_t kMaxRestarts = 3;
inline constexpr std::chrono::seconds kRestartSpan{60};

class RestartLimit {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Whether a frontal that died now may be started again; notes that it is. At most kMaxRestarts
  /// in any kRestartSpan.
  [[nodiscard]] bool allows(Time now) {
    while (!restarts_.empty() && now - restarts_.front() >= kRestartSpan) restarts_.pop_front();
    if (restarts_.size() >= kMaxRestarts) return false;
    restarts_.push_back(now);
    return true;
  }

 private:
  std::deque<Time> restarts_;
};

}  // namespace graycube
