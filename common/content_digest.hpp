// Tells contents apart by a number of 64 bits. Nobody is kept from making two contents of the same
// number on purpose; it is for what its own sender wants told apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>

namespace graycube {

class ContentDigest {
 public:
  /// Adds a part. The parts "ab", "c" differ from "a", "bc", as each part's length counts, too.
  ContentDigest& add(std::span<const std::byte> part) {
    mix(part.size());
    while (part.size() >= sizeof(std::uint64_t)) {
      mix(first_word(part));
      part = part.subspan(sizeof(std::uint64_t));
    }
    if (!part.empty()) mix(first_word(part));
    return *this;
  }
  ContentDigest& add(std::string_view text) {
    return add(std::as_bytes(std::span(text.data(), text.size())));
  }
  ContentDigest& add(std::uint64_t word) {
    mix(word);
    return *this;
  }
  std::uint64_t value() const { return value_ ^ value_ >> 29; }

 private:
  /// The first eight bytes, or all if there are fewer, with zeros behind them.
  static std::uint64_t first_word(std::span<const std::byte> part) {
    std::uint64_t word = 0;
    std::memcpy(&word, part.data(), part.size() < sizeof word ? part.size() : sizeof word);
    return word;
  }
  /// A step of SplitMix64 (Steele, Lea and Flood, 2014): each bit of the word changes about half of
  /// the value's.
  void mix(std::uint64_t word) {
    value_ = (value_ ^ word) + 0x9E3779B97F4A7C15;
    value_ = (value_ ^ value_ >> 30) * 0xBF58476D1CE4E5B9;
    value_ = (value_ ^ value_ >> 27) * 0x94D049BB133111EB;
  }

  std::uint64_t value_ = 0;
};

}  // namespace graycube
