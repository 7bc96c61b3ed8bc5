// The results of solving and of classifying a primitive.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace graycube {

/// The parts of a line inside a primitive: disjoint closed intervals [enter, leave], in order;
/// ±infinity if the primitive is unbounded. Tangency gives an interval of length zero or none.
class Spans {
 public:
  /// The most intervals of most kinds; more than these take memory.
  static constexpr int kMax = 2;
  struct Interval {
    double enter, leave;
  };
  class Intervals {
   public:
    const Interval& operator[](std::size_t i) const { return many_.empty() ? few_[i] : many_[i]; }

   private:
    friend class Spans;
    std::array<Interval, kMax> few_;
    std::vector<Interval> many_;
  };
  int count = 0;
  Intervals interval;

  void add(double enter, double leave) {
    if (count < kMax) [[likely]] {
      interval.few_[static_cast<std::size_t>(count++)] = {enter, leave};
      return;
    }
    if (count == kMax) interval.many_.assign(interval.few_.begin(), interval.few_.end());
    interval.many_.push_back({enter, leave});
    ++count;
  }
};

enum class CellSide : std::uint8_t { kOutside, kInside, kCrosses };

}  // namespace graycube
