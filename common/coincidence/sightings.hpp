// Finds which of many things may be the same, by measured numbers noted as the things are made.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "coincidence/candidates.hpp"
#include "stop_point.hpp"

namespace graycube::csg {

/// Keeps 16 bytes for each number, so that the things themselves, which are much larger, are looked
/// at only once: while they are made.
class Sightings {
 public:
  void reserve(std::size_t numbers) { seen_.reserve(numbers); }

  /// Adds a number of a primitive; all numbers of one primitive must be added in a row.
  void add(std::uint32_t primitive, const Measured& number) {
    // Rounded up: a float's rounding error is less than this share.
    constexpr float kUp = 1 + std::numeric_limits<float>::epsilon();
    const float tolerance = static_cast<float>(number.tolerance) * kUp;
    seen_.push_back({number.value, tolerance, primitive});
    tolerances_ += double{tolerance};
  }

  /// Calls visit(primitive) for each that has a number within tolerance of another number, be it
  /// one of its own. Only after that may_meet() can be called.
  template <typename Visit>
  void for_each_candidate(Visit&& visit) {
    if (seen_.empty()) return;
    candidates_.emplace(tolerances_ / static_cast<double>(seen_.size()), seen_.size());
    for (const Seen& s : seen_) {
      stop_if_asked();
      candidates_->mark(measured(s));
    }
    std::optional<std::uint32_t> last;
    for (const Seen& s : seen_) {
      stop_if_asked();
      if (s.primitive == last || !candidates_->may_meet(measured(s))) continue;
      last = s.primitive;
      visit(s.primitive);
    }
  }

  bool may_meet(const Measured& number) const { return candidates_->may_meet(number); }

 private:
  struct Seen {
    double value;
    float tolerance;
    std::uint32_t primitive;
  };
  static Measured measured(const Seen& s) { return {s.value, double{s.tolerance}}; }

  std::vector<Seen> seen_;
  double tolerances_ = 0;
  std::optional<Candidates> candidates_;
};

}  // namespace graycube::csg
