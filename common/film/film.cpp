#include "film/film.hpp"

#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

#include "check.hpp"

namespace graycube {
namespace {

__extension__ typedef __int128 Sum;
__extension__ typedef unsigned __int128 Magnitude;

int bit_width(Magnitude v) {
  const auto high = static_cast<std::uint64_t>(v >> 64);
  return high != 0 ? 64 + static_cast<int>(std::bit_width(high))
                   : static_cast<int>(std::bit_width(static_cast<std::uint64_t>(v)));
}

/// sum · 2^-32 / rays, rounded to nearest even once. The quotient is taken to about 40 bits; a
/// remainder sets the last of them, so that the conversion to 24 bits rounds as the exact value
/// would.
float mean(Magnitude sum, std::uint32_t rays) {
  if (sum == 0) return 0;
  const int shift = 40 + static_cast<int>(std::bit_width(rays)) - bit_width(sum);
  bool rest = false;
  if (shift >= 0) {
    sum <<= shift;
  } else {
    rest = (sum & ((Magnitude{1} << -shift) - 1)) != 0;
    sum >>= -shift;
  }
  rest = rest || sum % rays != 0;
  const auto quotient = static_cast<std::uint64_t>(sum / rays) | (rest ? 1u : 0u);
  return static_cast<float>(std::ldexp(static_cast<double>(quotient), -32 - shift));
}

/// Like mean(), for sums of 64 bits, as nearly all are: no 128-bit division, no library call. All
/// means are normal floats, so scaling by a power of two is exact.
class ShortMean {
 public:
  explicit ShortMean(std::uint32_t rays)
      : rays_(rays),
        is_power_(std::has_single_bit(rays)),
        scale_(power_of_two(-32 - std::countr_zero(rays))) {}

  float operator()(std::int64_t sum) const {
    // The processor's conversion rounds to nearest even.
    if (is_power_) return static_cast<float>(sum) * scale_;
    if (sum == 0) return 0;
    const auto size = static_cast<std::uint64_t>(sum < 0 ? -sum : sum);
    // 63 bits over 32 leave 31 at least, more than the 25 that rounding needs beside the folded
    // rest.
    const int shift = std::countl_zero(size) - 1;
    const std::uint64_t shifted = size << shift;
    const std::uint64_t quotient = shifted / rays_ | (shifted % rays_ != 0 ? 1u : 0u);
    const float mean =
        static_cast<float>(static_cast<std::int64_t>(quotient)) * power_of_two(-32 - shift);
    return sum < 0 ? -mean : mean;
  }

 private:
  /// 2^exponent, for exponents of normal floats.
  static float power_of_two(int exponent) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(127 + exponent) << 23);
  }

  std::uint64_t rays_;
  bool is_power_;
  float scale_;
};

/// Adds to a sum's lower half; returns the change of the upper half: −1, 0 or 1.
std::int64_t add_low(std::uint64_t& low, std::int64_t light) {
  const auto added = static_cast<std::uint64_t>(light);
  low += added;
  return (low < added ? 1 : 0) - (light < 0 ? 1 : 0);
}

std::uint64_t checked_pixels(std::uint32_t width, std::uint32_t height) {
  const std::uint64_t pixels = std::uint64_t{width} * height;
  GRAYCUBE_CHECK(width >= 1 && width <= kMaxPictureSide && height >= 1 &&
                     height <= kMaxPictureSide && pixels <= kMaxPicturePixels,
                 "%u x %u pixels", width, height);
  return pixels;
}

}  // namespace

Film::Film(std::uint32_t width, std::uint32_t height, std::uint32_t rays_per_pixel, AovSet aovs)
    : width_(width),
      height_(height),
      rays_per_pixel_(rays_per_pixel),
      low_(checked_pixels(width, height), ZeroPages::Use::kAllOver),
      high_(pixel_count() + 1, ZeroPages::Use::kHereAndThere),
      aovs_(aovs) {
  GRAYCUBE_CHECK(rays_per_pixel >= 1, "%u rays a pixel", rays_per_pixel);
  for (std::size_t p = 0; p < kAovPlanes; ++p) {
    if (has_plane(aovs_, p)) planes_[p].resize(pixel_count(), aov_background(p));
  }
}

bool Film::has_slot(std::uint32_t slot) const {
  const std::uint64_t plane = slot / pixel_count();
  return plane == 0 || (plane <= kAovPlanes && !planes_[plane - 1].empty());
}

void Film::add(std::uint32_t slot, const FixedRgb& light) {
  if (slot >= pixel_count()) [[unlikely]]
    return set_aovs(slot, light);
  Low& low = low_[slot];
  const High change{add_low(low.r, light.r), add_low(low.g, light.g), add_low(low.b, light.b)};
  if ((change.r | change.g | change.b) != 0) [[unlikely]]
    carry(slot, change);
}

void Film::set_aovs(std::uint32_t slot, const FixedRgb& words) {
  GRAYCUBE_CHECK(has_slot(slot), "slot %u, %zu pixels", slot,
                 static_cast<std::size_t>(pixel_count()));
  planes_[slot / pixel_count() - 1][slot % pixel_count()] = {static_cast<std::uint32_t>(words.r),
                                                             static_cast<std::uint32_t>(words.g),
                                                             static_cast<std::uint32_t>(words.b)};
}

void Film::carry(std::uint32_t pixel, const High& change) {
  High& high = high_[pixel];
  high.r += change.r;
  high.g += change.g;
  high.b += change.b;
  std::atomic_ref(high_[pixel_count()].r).store(1, std::memory_order_relaxed);
}

bool Film::has_high() const {
  return std::atomic_ref(high_[pixel_count()].r).load(std::memory_order_relaxed) != 0;
}

void Film::clear(std::uint32_t pixel) {
  GRAYCUBE_CHECK(pixel < pixel_count(), "pixel %u of %zu", pixel,
                 static_cast<std::size_t>(pixel_count()));
  low_[pixel] = {};
  if (has_high()) high_[pixel] = {};
  for (std::size_t p = 0; p < kAovPlanes; ++p) {
    if (!planes_[p].empty()) planes_[p][pixel] = aov_background(p);
  }
}

std::optional<FixedRgb> Film::short_sum(std::uint32_t pixel) const {
  const Low& low = low_[pixel];
  const High high = has_high() ? high_[pixel] : High{};
  const FixedRgb sum{static_cast<std::int64_t>(low.r), static_cast<std::int64_t>(low.g),
                     static_cast<std::int64_t>(low.b)};
  const auto fits = [](std::int64_t l, std::int64_t h) { return h == (l < 0 ? -1 : 0); };
  if (!fits(sum.r, high.r) || !fits(sum.g, high.g) || !fits(sum.b, high.b)) return std::nullopt;
  return sum;
}

Picture Film::develop() const {
  const ShortMean short_mean(rays_per_pixel_);
  const auto long_mean = [this](std::uint64_t low, std::int64_t high) {
    const Sum sum = static_cast<Sum>(static_cast<Magnitude>(high) << 64 | low);
    const float size = mean(static_cast<Magnitude>(sum < 0 ? -sum : sum), rays_per_pixel_);
    return sum < 0 ? -size : size;
  };
  const auto component = [&](std::uint64_t low, std::int64_t high) {
    const auto sum = static_cast<std::int64_t>(low);
    const bool fits = high == (sum < 0 ? -1 : 0) && sum != std::numeric_limits<std::int64_t>::min();
    return fits ? short_mean(sum) : long_mean(low, high);
  };
  const bool reads_high = has_high();
  const std::uint64_t pixels = pixel_count();
  Picture picture;
  picture.width = width_;
  picture.height = height_;
  picture.aovs = aovs_;
  picture.rgb.resize(3 * pixels);
  float* out = picture.rgb.data();
  for (std::uint64_t i = 0; i < pixels; ++i, out += 3) {
    const Low& low = low_[i];
    const High high = reads_high ? high_[i] : High{};
    out[0] = component(low.r, high.r);
    out[1] = component(low.g, high.g);
    out[2] = component(low.b, high.b);
  }
  for (std::size_t p = 0; p < kAovPlanes; ++p) {
    picture.aov_planes[p].reserve(3 * planes_[p].size());
    for (const AovWords& words : planes_[p]) {
      picture.aov_planes[p].insert(picture.aov_planes[p].end(), words.begin(), words.end());
    }
  }
  return picture;
}

}  // namespace graycube
