// The pixels of a rectangle, and a walk over them, row by row.
#pragma once

#include <cstddef>
#include <cstdint>

#include "regions/macro_grid.hpp"

namespace graycube {

/// The number of pixels in a rectangle that isn't empty.
inline std::size_t pixel_count_of(const PixelRect& rect) {
  return std::size_t{rect.x1 - rect.x0} * (rect.y1 - rect.y0);
}

/// Calls act(pixel, i) for the pixels of a rectangle, in rows from the top: `pixel` is the index in
/// a picture of this width, i counts from 0.
template <typename Act>
void each_pixel_of(const PixelRect& rect, std::uint32_t width, Act&& act) {
  std::size_t i = 0;
  for (std::uint32_t y = rect.y0; y < rect.y1; ++y) {
    for (std::uint32_t x = rect.x0; x < rect.x1; ++x) act(y * width + x, i++);
  }
}

}  // namespace graycube
