// Turns linear light into the whole numbers of a PNG. Every machine gives the same numbers.
#pragma once

#include <cstdint>

namespace graycube {

/// floor(65535 · clamp(v, 0, 1) + 0.5), in double precision; NaN gives 0.
std::uint16_t linear_16_bit(float v);

/// floor(255 · f(clamp(v, 0, 1)) + 0.5) with sRGB's transfer function f (IEC 61966-2-1: 12.92 v up
/// to 0.0031308, 1.055 v^(1/2.4) − 0.055 above); NaN gives 0.
std::uint8_t srgb_8_bit(float v);

}  // namespace graycube
