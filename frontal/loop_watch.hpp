// Watches how long the mailroom's turns take: whoever asks it something waits that long.
#pragma once

#include <array>
#include <cstdio>
#include <string>

#include "process/clocks.hpp"

namespace graycube {

/// A turn of the loop that takes more of the thread's own time, and more than any before, is told,
/// so that what holds the loop up is found.
inline constexpr double kLongTurn_s = 0.05;

class LoopWatch {
 public:
  /// A turn begins: events that came are worked on from here on.
  void begin(double now_s) {
    began_s_ = now_s;
    cpu_began_s_ = seconds_of(CLOCK_THREAD_CPUTIME_ID);
  }
  /// It ends: the loop waits for the next event. Returns what is to be told, or nothing.
  std::string end(double now_s) {
    last_turn_s_ = now_s - began_s_;
    if (now_s - began_s_ < longest_s_) return {};
    const double cpu_s = seconds_of(CLOCK_THREAD_CPUTIME_ID) - cpu_began_s_;
    if (cpu_s < longest_s_) return {};
    longest_s_ = cpu_s;
    std::array<char, 96> text{};
    std::snprintf(text.data(), text.size(),
                  "frontal: held up for %.3f s, %.3f s of it by its own work", now_s - began_s_,
                  cpu_s);
    return text.data();
  }
  /// How long the turn took that has ended last.
  double last_turn_s() const { return last_turn_s_; }

 private:
  double last_turn_s_ = 0, began_s_ = 0, cpu_began_s_ = 0, longest_s_ = kLongTurn_s;
};

}  // namespace graycube
