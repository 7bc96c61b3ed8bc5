// The light that is sent to the picture, and the credit that comes back with it.
#pragma once

#include <cstdint>

#include "coordination/credit.hpp"
#include "film/fixed_point.hpp"

namespace graycube {

/// Light for one pixel; several contributions to it may have been merged into one.
struct Contribution {
  std::uint32_t pixel = 0;
  FixedRgb light;

  friend bool operator==(const Contribution&, const Contribution&) = default;
};

/// Whether the sum is more than one record can hold.
inline bool is_too_much(const FixedRgb& a, const FixedRgb& b) {
  return a.r > kMaxMergedLight - b.r || a.g > kMaxMergedLight - b.g || a.b > kMaxMergedLight - b.b;
}

struct TileCredit {
  std::uint32_t tile = 0;
  Credit credit;

  friend bool operator==(const TileCredit&, const TileCredit&) = default;
};

}  // namespace graycube
