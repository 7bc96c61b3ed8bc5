// The accumulator behind a picture: 128-bit sums of fixed-point light.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "film/aov.hpp"
#include "film/fixed_point.hpp"
#include "memory/large_pages.hpp"

namespace graycube {

/// The largest side and number of pixels of a picture that is made or read.
inline constexpr std::uint32_t kMaxPictureSide = 1u << 16;
inline constexpr std::uint64_t kMaxPicturePixels = 1ull << 26;

/// A finished picture: linear 32-bit floats, row-major from the top left, three per pixel.
struct Picture {
  std::uint32_t width = 0, height = 0;
  std::vector<float> rgb;
  AovSet aovs{};
  /// Three words a pixel, laid out like rgb; empty for planes that `aovs` doesn't need.
  std::array<std::vector<std::uint32_t>, kAovPlanes> aov_planes{};

  friend bool operator==(const Picture&, const Picture&) = default;
};

class Film {
 public:
  /// `rays_per_pixel` is S × S, at least 1; every pixel's sum is divided by it at the end. Sides
  /// are 1 to kMaxPictureSide, pixels up to kMaxPicturePixels: 24 bytes each, 24 more for those
  /// whose sums leave 64 bits, and 12 more for each plane of AOVs. Throws std::bad_alloc.
  Film(std::uint32_t width, std::uint32_t height, std::uint32_t rays_per_pixel, AovSet aovs = {});

  std::uint32_t width() const { return width_; }
  std::uint64_t pixel_count() const { return std::uint64_t{width_} * height_; }
  /// Whether `add` takes this slot: a pixel, or one of a plane of AOVs that is kept.
  bool has_slot(std::uint32_t slot) const;
  /// Adds light to pixel number y · width + x, or sets AOVs (see aov_slot); has_slot(slot).
  /// Different threads may add to different pixels at once.
  void add(std::uint32_t slot, const FixedRgb& light);
  /// Forgets what a pixel has received, its AOVs too (its tile will be traced again).
  void clear(std::uint32_t pixel);
  // For records of what a film holds.
  /// A pixel's sums, unless they leave 64 bits.
  std::optional<FixedRgb> short_sum(std::uint32_t pixel) const;
  bool has_plane_of_aovs(std::size_t plane) const { return !planes_[plane].empty(); }
  /// The words of a plane that is kept.
  const AovWords& aov_words(std::size_t plane, std::uint32_t pixel) const {
    return planes_[plane][pixel];
  }
  void set_aov_words(std::size_t plane, std::uint32_t pixel, const AovWords& words) {
    planes_[plane][pixel] = words;
  }
  /// The mean over each pixel's rays, rounded to float once.
  Picture develop() const;

 private:
  /// A pixel's three sums, or their upper halves.
  struct Low {
    std::uint64_t r = 0, g = 0, b = 0;
  };
  struct High {
    std::int64_t r = 0, g = 0, b = 0;
  };

  void set_aovs(std::uint32_t slot, const FixedRgb& words);
  void carry(std::uint32_t pixel, const High& change);
  bool has_high() const;

  std::uint32_t width_, height_, rays_per_pixel_;
  /// Sums in two's complement, 128 bits each: high · 2^64 + low. Hardly any sum needs its upper
  /// half, so those lie apart, in zero pages that the system provides when they are first written.
  ZeroedArray<Low> low_;
  /// One more than there are pixels: the last one's r is not 0 when any of the others was written.
  ZeroedArray<High> high_;
  AovSet aovs_;
  std::array<std::vector<AovWords>, kAovPlanes> planes_;
};

}  // namespace graycube
