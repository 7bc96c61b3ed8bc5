#include "flat/side_crossings.hpp"

#include <algorithm>
#include <vector>

#include "flat/simple_outlines.hpp"

namespace graycube {
namespace {

struct Side {
  FlatPoint a, b, lo, hi;
};

std::vector<Side> sides_of(std::span<const FlatLoops> operands) {
  std::vector<Side> sides;
  for (const FlatLoops& loops : operands) {
    for (const FlatLoop& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const FlatPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
        sides.push_back({a,
                         b,
                         {std::min(a.x, b.x), std::min(a.y, b.y)},
                         {std::max(a.x, b.x), std::max(a.y, b.y)}});
      }
    }
  }
  return sides;
}

bool cross(const Side& s, const Side& t) {
  return orientation(s.a, s.b, t.a) * orientation(s.a, s.b, t.b) < 0 &&
         orientation(t.a, t.b, s.a) * orientation(t.a, t.b, s.b) < 0;
}

/// Whether Clipper's line, which stops at the height of every corner, passes few sides in all.
bool are_passed_soon(const std::vector<Side>& sides) {
  std::vector<double> heights;
  for (const Side& side : sides) heights.push_back(side.a.y);
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  std::size_t passed = 0;
  for (const Side& side : sides) {
    const auto low = std::lower_bound(heights.begin(), heights.end(), side.lo.y);
    const auto high = std::lower_bound(low, heights.end(), side.hi.y);
    passed += static_cast<std::size_t>(high - low);
  }
  return passed <= kMaxFlatPasses;
}

/// Whether it is one figure of many corners that is taken without Clipper.
bool is_many_and_simple(std::span<const FlatLoops> operands) {
  if (operands.size() != 1) return false;
  std::size_t corners = 0;
  for (const FlatLoop& loop : operands.front()) corners += loop.size();
  return corners > kManyFlatCorners && simple_regions(operands.front());
}

}  // namespace

bool crossings_are_few(std::span<const FlatLoops> operands) {
  std::size_t left = kMaxFlatCrossings;
  return crossings_are_few(operands, left);
}

bool crossings_are_few(std::span<const FlatLoops> operands, std::size_t& left) {
  if (is_many_and_simple(operands)) return true;
  std::vector<Side> sides = sides_of(operands);
  if (!are_passed_soon(sides)) return false;
  std::sort(sides.begin(), sides.end(),
            [](const Side& s, const Side& t) { return s.lo.x < t.lo.x; });
  std::size_t tests = 0, overlaps = 0, crossings = 0;
  const std::size_t most = std::min(left, kMaxFlatCrossings);
  for (std::size_t i = 0; i < sides.size(); ++i) {
    for (std::size_t j = i + 1; j < sides.size() && sides[j].lo.x <= sides[i].hi.x; ++j) {
      if (++tests > 64 * kMaxFlatOverlaps) return false;
      if (sides[j].lo.y > sides[i].hi.y || sides[i].lo.y > sides[j].hi.y) continue;
      if (++overlaps > kMaxFlatOverlaps) return false;
      if (cross(sides[i], sides[j]) && ++crossings > most) return false;
    }
  }
  left -= crossings;
  return true;
}

}  // namespace graycube
