#include "film/film.hpp"

#include <bit>
#include <cmath>
#include <cstddef>

#include "geometry/check.hpp"

namespace graycube {
namespace {

__extension__ typedef unsigned __int128 Magnitude;

int bit_width(Magnitude v) {
  const auto high = static_cast<std::uint64_t>(v >> 64);
  return high != 0 ? 64 + static_cast<int>(std::bit_width(high))
                   : static_cast<int>(std::bit_width(static_cast<std::uint64_t>(v)));
}

/// sum · 2^-32 / rays, rounded to nearest even once. The quotient is taken to about 40 bits; what
/// lies below them is folded into the last one, so that the conversion to 24 bits rounds as the
/// exact value would.
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

}  // namespace

Film::Film(std::uint32_t width, std::uint32_t height, std::uint32_t rays_per_pixel)
    : width_(width), height_(height), rays_per_pixel_(rays_per_pixel) {
  GRAYCUBE_CHECK(width >= 1 && width <= kMaxPictureSide && height >= 1 &&
                     height <= kMaxPictureSide && pixel_count() <= kMaxPicturePixels &&
                     rays_per_pixel >= 1,
                 "%u x %u pixels, %u rays each", width, height, rays_per_pixel);
  pixels_.resize(pixel_count());
}

void Film::add(std::uint32_t pixel, const FixedRgb& light) {
  GRAYCUBE_CHECK(pixel < pixels_.size(), "pixel %u of %zu", pixel, pixels_.size());
  Pixel& sum = pixels_[pixel];
  sum.r += light.r;
  sum.g += light.g;
  sum.b += light.b;
}

void Film::clear(std::uint32_t pixel) {
  GRAYCUBE_CHECK(pixel < pixels_.size(), "pixel %u of %zu", pixel, pixels_.size());
  pixels_[pixel] = {};
}

Picture Film::develop() const {
  const auto component = [this](Sum sum) {
    const float size = mean(static_cast<Magnitude>(sum < 0 ? -sum : sum), rays_per_pixel_);
    return sum < 0 ? -size : size;
  };
  Picture picture{width_, height_, {}};
  picture.rgb.reserve(3 * pixels_.size());
  for (const Pixel& pixel : pixels_) {
    for (const Sum sum : {pixel.r, pixel.g, pixel.b}) picture.rgb.push_back(component(sum));
  }
  return picture;
}

}  // namespace graycube
