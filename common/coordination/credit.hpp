// Exact sums of tile credit (Mattern's weight throwing). Every primary ray starts with credit 1; a
// ray with credit 2^-e splits it among its children and its own contribution; a tile is whole once
// the credit that came back equals its number of primary rays.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace graycube {

/// A non-negative fixed-point number: word 0 holds the integer part, words 1 … 4 the 256 fractional
/// bits, most significant first.
class Credit {
 public:
  static constexpr int kWords = 5;
  static constexpr int kMaxExponent = 255;

  constexpr Credit() = default;
  static constexpr Credit from_words(const std::array<std::uint64_t, kWords>& words) {
    Credit c;
    c.words_ = words;
    return c;
  }

  /// Adds 2^-exponent, 0 ≤ exponent ≤ kMaxExponent.
  constexpr void add_power(int exponent) {
    const int word = exponent == 0 ? 0 : 1 + (exponent - 1) / 64;
    const int bit = exponent == 0 ? 0 : 63 - (exponent - 1) % 64;
    add_to_word(word, std::uint64_t{1} << bit);
  }
  constexpr void add(const Credit& other) {
    const auto added = other.words_;  // a copy: `other` may be this very sum
    for (int w = kWords - 1; w >= 0; --w) add_to_word(w, added[static_cast<std::size_t>(w)]);
  }
  constexpr bool is_zero() const { return *this == Credit{}; }
  constexpr bool is_exactly(std::uint64_t units) const {
    return *this == from_words({units, 0, 0, 0, 0});
  }
  constexpr const std::array<std::uint64_t, kWords>& words() const { return words_; }
  friend constexpr bool operator==(const Credit&, const Credit&) = default;

 private:
  constexpr void add_to_word(int word, std::uint64_t amount) {
    for (int w = word; w >= 0 && amount != 0; --w) {
      auto& value = words_[static_cast<std::size_t>(w)];
      value += amount;
      amount = value < amount ? 1 : 0;
    }
  }

  std::array<std::uint64_t, kWords> words_{};
};

}  // namespace graycube
