// Sorting that can be stopped on the way (stop_point.hpp): of millions of things it takes seconds.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>

#include "stop_point.hpp"

namespace graycube {

/// Things that are sorted at once: it takes some milliseconds.
inline constexpr std::size_t kSortedAtOnce = std::size_t{1} << 16;

/// Like std::sort. Throws WorkStopped; then the order is any.
template <typename T, typename Before = std::less<>>
void stoppable_sort(std::span<T> things, Before before = {}) {
  stop_if_asked();
  if (things.size() <= kSortedAtOnce) return std::sort(things.begin(), things.end(), before);
  // As quicksort does, but only down to where std::sort is quick; it never degenerates, since
  // nth_element finds the true middle.
  const auto middle = things.begin() + static_cast<std::ptrdiff_t>(things.size() / 2);
  std::nth_element(things.begin(), middle, things.end(), before);
  const auto half = things.size() / 2;
  stoppable_sort(things.first(half), before);
  stoppable_sort(things.subspan(half), before);
}

}  // namespace graycube
