// A walk over a rectangle's pixels, row by row.
#pragma once

#include <cstddef>
#include <cstdint>

#include "regions/macro_grid.hpp"

namespace graycube {

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
