// The set bits of a mask as a range, the one way in which loops over masks are written.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <iterator>

namespace graycube {

/// The numbers of the bits that are set in a mask, the lowest first:
/// `for (const std::size_t i : SetBits(mask))`. The mask is copied: what the loop's body does to it
/// changes nothing.
template <std::unsigned_integral Mask>
class SetBits {
 public:
  class Iterator {
   public:
    explicit constexpr Iterator(Mask left) : left_(left) {}
    constexpr std::size_t operator*() const {
      return static_cast<std::size_t>(std::countr_zero(left_));
    }
    constexpr Iterator& operator++() {
      left_ &= left_ - 1;
      return *this;
    }
    constexpr bool operator==(std::default_sentinel_t) const { return left_ == 0; }

   private:
    Mask left_;
  };

  explicit constexpr SetBits(Mask mask) : mask_(mask) {}
  constexpr Iterator begin() const { return Iterator(mask_); }
  constexpr std::default_sentinel_t end() const { return {}; }

 private:
  Mask mask_;
};

}  // namespace graycube
