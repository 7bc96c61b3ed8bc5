// The binary reflected Gray code: consecutive numbers, the last and the first of a power of two
// included, differ in one bit.
#pragma once

#include <cstdint>

namespace graycube {

constexpr std::uint32_t gray_code(std::uint32_t position) { return position ^ (position >> 1); }

/// The position that has this code: the inverse of gray_code().
constexpr std::uint32_t gray_rank(std::uint32_t code) {
  for (int shift = 16; shift > 0; shift /= 2) code ^= code >> shift;
  return code;
}

}  // namespace graycube
