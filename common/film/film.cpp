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

Film::Film(std::uint32_t width, std::uint32_t height, std::uint32_t rays_per_pixel, AovSet aovs)
    : width_(width), height_(height), rays_per_pixel_(rays_per_pixel), aovs_(aovs) {
  GRAYCUBE_CHECK(width >= 1 && width <= kMaxPictureSide && height >= 1 &&
                     height <= kMaxPictureSide && pixel_count() <= kMaxPicturePixels &&
                     rays_per_pixel >= 1,
                 "%u x %u pixels, %u rays each", width, height, rays_per_pixel);
  pixels_.resize(pixel_count());
  for (std::size_t p = 0; p < kAovPlanes; ++p) {
    if (has_plane(aovs_, p)) planes_[p].resize(pixel_count(), aov_background(p));
  }
}

bool Film::has_slot(std::uint32_t slot) const {
  const std::size_t plane = slot / pixels_.size();
  return plane == 0 || (plane <= kAovPlanes && !planes_[plane - 1].empty());
}

void Film::add(std::uint32_t slot, const FixedRgb& light) {
  GRAYCUBE_CHECK(has_slot(slot), "slot %u, %zu pixels", slot, pixels_.size());
  const std::size_t pixel = slot % pixels_.size();
  if (slot >= pixels_.size()) {
    planes_[slot / pixels_.size() - 1][pixel] = {static_cast<std::uint32_t>(light.r),
                                                 static_cast<std::uint32_t>(light.g),
                                                 static_cast<std::uint32_t>(light.b)};
    return;
  }
  Pixel& sum = pixels_[pixel];
  sum.r += light.r;
  sum.g += light.g;
  sum.b += light.b;
}

void Film::clear(std::uint32_t pixel) {
  GRAYCUBE_CHECK(pixel < pixels_.size(), "pixel %u of %zu", pixel, pixels_.size());
  pixels_[pixel] = {};
  for (std::size_t p = 0; p < kAovPlanes; ++p) {
    if (!planes_[p].empty()) planes_[p][pixel] = aov_background(p);
  }
}

Picture Film::develop() const {
  const auto component = [this](Sum sum) {
    const float size = mean(static_cast<Magnitude>(sum < 0 ? -sum : sum), rays_per_pixel_);
    return sum < 0 ? -size : size;
  };
  Picture picture;
  picture.width = width_;
  picture.height = height_;
  picture.aovs = aovs_;
  picture.rgb.reserve(3 * pixels_.size());
  for (const Pixel& pixel : pixels_) {
    for (const Sum sum : {pixel.r, pixel.g, pixel.b}) picture.rgb.push_back(component(sum));
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
