#include "set_bits.hpp"

#include <cstdint>
#include <vector>

#include "catch.hpp"

namespace {

using graycube::SetBits;

template <typename Mask>
std::vector<std::size_t> bits_of(Mask mask) {
  std::vector<std::size_t> bits;
  for (const std::size_t i : SetBits(mask)) bits.push_back(i);
  return bits;
}

}  // namespace

TEST_CASE("the set bits of a mask come each once, the lowest first") {
  CHECK(bits_of(0u).empty());
  CHECK(bits_of(0b101001u) == std::vector<std::size_t>{0, 3, 5});
  CHECK(bits_of(std::uint64_t{1} << 63 | 1) == std::vector<std::size_t>{0, 63});
  CHECK(bits_of(~std::uint32_t{0}).size() == 32);
}

TEST_CASE("a loop over set bits goes on whatever becomes of the mask") {
  std::uint32_t mask = 0b111;
  std::size_t count = 0;
  for (const std::size_t i : SetBits(mask)) {
    mask = 0;
    count += i;
  }
  CHECK(count == 3);
}
