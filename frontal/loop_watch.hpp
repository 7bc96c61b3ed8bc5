// Watches how long the mailroom's turns take: whoever asks it something waits that long.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "process/clocks.hpp"

namespace graycube {

/// A turn of the loop that takes longer is told on standard error, so that what holds it up is
/// found; at most once in so many seconds.
inline constexpr double kLongTurn_s = 0.05, kLongTurnPause_s = 1;

class LoopWatch {
 public:
  /// A turn begins: events that came are worked on from here on.
  void begin(double now_s) {
    began_s_ = now_s;
    cpu_began_s_ = seconds_of(CLOCK_THREAD_CPUTIME_ID);
  }
  /// It ends: the loop waits for the next event.
  void end(double now_s) {
    const double took_s = now_s - began_s_;
    longest_s_ = std::max(longest_s_, took_s);
    if (took_s < kLongTurn_s || now_s - told_s_ < kLongTurnPause_s) return;
    told_s_ = now_s;
    const double cpu_s = seconds_of(CLOCK_THREAD_CPUTIME_ID) - cpu_began_s_;
    std::fprintf(stderr,
                 "graycube-frontal: held up for %.3f s, %.3f s of it by its own work "
                 "(longest so far %.3f s)\n",
                 took_s, cpu_s, longest_s_);
  }
  double longest_s() const { return longest_s_; }

 private:
  double began_s_ = 0, cpu_began_s_ = 0, longest_s_ = 0, told_s_ = -kLongTurnPause_s;
};

}  // namespace graycube
