// Explicit little-endian bytes. A writer that fills a buffer of known size and a reader whose
// failure is sticky: after the first read past the end every read gives zero, and `ok()` stays
// false. Received bytes are never taken for structs; on little-endian machines each field is still
// one plain load or store.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "check.hpp"

namespace graycube {

/// The unsigned integer that holds the bits of a wire field: integers of 1, 2, 4 or 8 bytes, float,
/// double.
template <class T>
using WireBits = std::conditional_t<
    sizeof(T) == 1, std::uint8_t,
    std::conditional_t<sizeof(T) == 2, std::uint16_t,
                       std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;

/// Swaps the bytes of `bits` on big-endian machines.
template <class Bits>
constexpr Bits to_little_endian(Bits bits) {
  if constexpr (std::endian::native == std::endian::big && sizeof(Bits) > 1) {
    Bits swapped = 0;
    for (std::size_t i = 0; i < sizeof(Bits); ++i) {
      swapped = static_cast<Bits>(static_cast<Bits>(swapped << 8) | ((bits >> (8 * i)) & 0xFF));
    }
    return swapped;
  } else {
    return bits;
  }
}

/// Reads sizeof(T) bytes at `from`; the caller has checked that they are there.
template <class T>
T load_little(const std::byte* from) {
  static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool> && sizeof(T) <= 8);
  WireBits<T> bits;
  std::memcpy(&bits, from, sizeof bits);
  return std::bit_cast<T>(to_little_endian(bits));
}

/// Writes sizeof(T) bytes at `to`; the caller has made the room.
template <class T>
void store_little(std::byte* to, T value) {
  static_assert(std::is_arithmetic_v<T> && !std::is_same_v<T, bool> && sizeof(T) <= 8);
  const auto bits = to_little_endian(std::bit_cast<WireBits<T>>(value));
  std::memcpy(to, &bits, sizeof bits);
}

/// The `kBytes` low bytes of an integer, 1 to 8, at `from`.
template <std::size_t kBytes>
std::uint64_t load_low_bytes(const std::byte* from) {
  static_assert(kBytes >= 1 && kBytes <= sizeof(std::uint64_t));
  std::uint64_t bits = 0;
  std::memcpy(&bits, from, kBytes);
  return to_little_endian(bits);
}

template <std::size_t kBytes>
void store_low_bytes(std::byte* to, std::uint64_t value) {
  static_assert(kBytes >= 1 && kBytes <= sizeof(std::uint64_t));
  const std::uint64_t bits = to_little_endian(value);
  std::memcpy(to, &bits, kBytes);
}

/// Fills a message whose size is known beforehand. Writing past it is a bug of ours and aborts.
class ByteWriter {
 public:
  explicit ByteWriter(std::size_t size) : bytes_(size) {}

  template <class T>
  void put(T value) {
    store_little(room(sizeof(T)), value);
  }
  /// Skips `count` bytes, which the caller must fill.
  std::byte* room(std::size_t count) {
    GRAYCUBE_CHECK(count <= bytes_.size() - used_, "%zu bytes into %zu of %zu", count, used_,
                   bytes_.size());
    std::byte* at = bytes_.data() + used_;
    used_ += count;
    return at;
  }
  /// The message, which must be exactly full.
  std::vector<std::byte> take() && {
    GRAYCUBE_CHECK(used_ == bytes_.size(), "%zu of %zu bytes written", used_, bytes_.size());
    return std::move(bytes_);
  }

 private:
  std::vector<std::byte> bytes_;
  std::size_t used_ = 0;
};

/// A bounded cursor over received bytes, which must outlive it.
class ByteReader {
 public:
  explicit ByteReader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  T get() {
    const std::byte* at = take(sizeof(T));
    return at != nullptr ? load_little<T>(at) : T{};
  }
  /// The next `count` bytes, or null (and failure for good) when fewer are left.
  const std::byte* take(std::size_t count) {
    if (!ok_ || count > bytes_.size() - used_) [[unlikely]] {
      ok_ = false;
      return nullptr;
    }
    const std::byte* at = bytes_.data() + used_;
    used_ += count;
    return at;
  }
  bool ok() const { return ok_; }
  std::size_t remaining() const { return ok_ ? bytes_.size() - used_ : 0; }

 private:
  std::span<const std::byte> bytes_;
  std::size_t used_ = 0;
  bool ok_ = true;
};

}  // namespace graycube
