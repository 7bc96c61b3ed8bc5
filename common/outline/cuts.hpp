// Where one line crosses an outline that was turned or swept.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "geometry/spans.hpp"
#include "outline/pieces.hpp"

namespace graycube {

struct OutlineCut {
  /// The line's parameter.
  double t = 0;
  const OutlinePiece* piece = nullptr;
  /// The piece's parameter.
  double v = 0;
};

/// The cuts of a line, an even number; few take no memory.
class OutlineCuts {
 public:
  void add(const OutlineCut& cut) {
    if (count_ < kFew) [[likely]] {
      few_[count_++] = cut;
      return;
    }
    if (many_.empty()) many_.assign(few_.begin(), few_.end());
    many_.push_back(cut);
    ++count_;
  }
  std::size_t size() const { return count_; }
  const OutlineCut& operator[](std::size_t i) const { return begin()[i]; }

  /// Sorts by t, and drops pairs at the same t: there the line touches two sides, or passes between
  /// loops that touch.
  void settle() {
    std::stable_sort(begin(), begin() + count_,
                     [](const OutlineCut& a, const OutlineCut& b) { return a.t < b.t; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (kept > 0 && begin()[kept - 1].t == begin()[i].t) {
        --kept;
      } else {
        begin()[kept++] = begin()[i];
      }
    }
    count_ = kept;
  }

 private:
  static constexpr std::size_t kFew = 16;
  OutlineCut* begin() { return many_.empty() ? few_.data() : many_.data(); }
  const OutlineCut* begin() const { return many_.empty() ? few_.data() : many_.data(); }

  std::size_t count_ = 0;
  std::array<OutlineCut, kFew> few_;
  std::vector<OutlineCut> many_;
};

}  // namespace graycube
