// Watches how long the mailroom's turns take: whoever asks it something waits that long.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>

#include "process/clocks.hpp"

namespace graycube {

/// A turn of the loop that takes more of the thread's own time, and more than any before, is told
/// on standard error, so that what holds the loop up is found.
inline constexpr double kLongTurn_s = 0.05;

class LoopWatch {
 public:
  /// A turn begins: events that came are worked on from here on.
  void begin(double now_s) {
    began_s_ = now_s;
    cpu_began_s_ = seconds_of(CLOCK_THREAD_CPUTIME_ID);
  }
  /// It ends: the loop waits for the next event.
  void end(double now_s) {
    if (now_s - began_s_ < longest_s_) return;
    const double cpu_s = seconds_of(CLOCK_THREAD_CPUTIME_ID) - cpu_began_s_;
    if (cpu_s < longest_s_) return;
    longest_s_ = cpu_s;
    std::fprintf(stderr, "graycube-frontal: held up for %.3f s, %.3f s of it by its own work\n",
                 now_s - began_s_, cpu_s);
  }

 private:
  double began_s_ = 0, cpu_began_s_ = 0, longest_s_ = kLongTurn_s;
};

}  // namespace graycube
