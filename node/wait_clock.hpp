// What evaluators wait for, and how long: every moment of an evaluator without work is counted
// under the reason that the brain gives for it.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>

#include "node/node.hpp"

namespace graycube {

class WaitClock {
 public:
  using Time = std::chrono::steady_clock::time_point;

  /// Call after each change of the brain, or of the number of waiting evaluators.
  void update(Time now, WaitReason reason, unsigned waiting, bool rendering) {
    if (rendering_) {
      const double passed = std::chrono::duration<double>(now - since_).count();
      seconds_[static_cast<std::size_t>(reason_)] += passed * waiting_;
    }
    since_ = now;
    reason_ = reason;
    waiting_ = waiting;
    rendering_ = rendering;
  }

  double seconds(WaitReason reason) const { return seconds_[static_cast<std::size_t>(reason)]; }
  void reset() { seconds_ = {}; }

 private:
  std::array<double, kWaitReasons> seconds_{};
  Time since_{};
  WaitReason reason_ = WaitReason::kIdle;
  unsigned waiting_ = 0;
  bool rendering_ = false;
};

}  // namespace graycube
