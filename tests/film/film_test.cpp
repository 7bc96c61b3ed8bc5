#include "film/film.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "catch.hpp"

using namespace graycube;

namespace {

struct Arrival {
  std::uint32_t pixel = 0;
  FixedRgb light;
};

double uniform(std::mt19937_64& engine, double lo, double hi) {
  return lo + (hi - lo) * (static_cast<double>(engine() >> 11) * 0x1p-53);
}

/// Light of many magnitudes, some of it broken.
std::vector<Arrival> random_arrivals(std::mt19937_64& engine, std::uint32_t pixels, int count) {
  std::vector<Arrival> arrivals;
  RoundingCounts counts;
  for (int i = 0; i < count; ++i) {
    Rgb light{uniform(engine, 0, 1), std::exp2(uniform(engine, -30, 19)), uniform(engine, 0, 1e-9)};
    if (i % 97 == 0) light.r = std::numeric_limits<double>::infinity();
    arrivals.push_back({static_cast<std::uint32_t>(engine() % pixels), to_fixed(light, counts)});
  }
  return arrivals;
}

Picture picture_of(const std::vector<Arrival>& arrivals, std::uint32_t width, std::uint32_t height,
                   std::uint32_t rays) {
  Film film(width, height, rays);
  for (const Arrival& arrival : arrivals) film.add(arrival.pixel, arrival.light);
  return film.develop();
}

__extension__ typedef __int128 Wide;
__extension__ typedef unsigned __int128 UnsignedWide;

/// sum · 2^-32 / rays rounded to float once, bit by bit in 128-bit integers: for sums below 2^90.
float slow_mean(Wide sum, std::uint32_t rays) {
  if (sum == 0) return 0;
  auto size = static_cast<UnsignedWide>(sum < 0 ? -sum : sum);
  int exponent = -32;
  for (; size >> 95 == 0; --exponent) size <<= 1;  // 64 bits of quotient at least
  UnsignedWide quotient = size / rays;
  bool rest = size % rays != 0;
  bool half = false;
  for (; quotient >> 24 != 0; ++exponent) {
    rest = rest || half;
    half = (quotient & 1) != 0;
    quotient >>= 1;
  }
  if (half && (rest || (quotient & 1) != 0)) ++quotient;
  const float mean = std::ldexp(static_cast<float>(static_cast<std::uint64_t>(quotient)), exponent);
  return sum < 0 ? -mean : mean;
}

/// Any magnitude below 2^63, of either sign; often with few bits set, so that ties are met.
std::int64_t random_fixed(std::mt19937_64& engine) {
  std::uint64_t bits = engine() >> 1 >> engine() % 62;
  if (engine() % 2 == 0) bits &= engine() & engine();
  if (engine() % 4 == 0) bits &= ~std::uint64_t{0} << engine() % 40;
  const auto size = static_cast<std::int64_t>(bits);
  return engine() % 4 == 0 ? -size : size;
}

/// One red component, developed.
float developed(std::int64_t fixed, std::uint32_t rays) {
  Film film(1, 1, rays);
  film.add(0, {fixed, 0, 0});
  return film.develop().rgb[0];
}

}  // namespace

TEST_CASE("the order in which light arrives does not show in the picture") {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    std::mt19937_64 engine(seed);
    auto arrivals = random_arrivals(engine, 6 * 4, 5000);
    const Picture first = picture_of(arrivals, 6, 4, 9);
    for (int i = 0; i < 10; ++i) {
      std::shuffle(arrivals.begin(), arrivals.end(), engine);
      CHECK(picture_of(arrivals, 6, 4, 9) == first);
    }
  }
}

TEST_CASE("contributions merged on the way give the same picture as single ones") {
  std::mt19937_64 engine(4);
  const auto arrivals = random_arrivals(engine, 5, kMaxMergedContributions);
  Film merged(5, 1, 4);
  std::vector<FixedRgb> partial(5);
  for (const Arrival& arrival : arrivals) partial[arrival.pixel].add(arrival.light);
  for (std::uint32_t pixel = 0; pixel < 5; ++pixel) merged.add(pixel, partial[pixel]);
  CHECK(merged.develop() == picture_of(arrivals, 5, 1, 4));
}

TEST_CASE("as many of the brightest contributions as may be merged fit 64 bits") {
  RoundingCounts counts;
  const std::int64_t brightest = to_fixed(1e300, counts);
  CHECK(brightest == std::int64_t{1} << 52);
  CHECK(brightest <= std::numeric_limits<std::int64_t>::max() / kMaxMergedContributions);
}

TEST_CASE("broken, negative and blinding components are mended and counted") {
  RoundingCounts counts;
  constexpr double kInf = std::numeric_limits<double>::infinity();
  CHECK(to_fixed(Rgb{std::nan(""), kInf, -kInf}, counts) == FixedRgb{0, 0, 0});
  CHECK(counts.non_finite == 3);
  CHECK(counts.clamped == 0);
  const auto one = std::int64_t{1} << 32;
  CHECK(to_fixed(Rgb{-1e-9, 1048577, 1}, counts) == FixedRgb{0, one << 20, one});
  CHECK(counts.non_finite == 3);
  CHECK(counts.clamped == 2);
  CHECK(to_fixed(Rgb{0, kMaxContribution, 0.5}, counts) == FixedRgb{0, one << 20, one / 2});
  CHECK(counts.clamped == 2);
}

TEST_CASE("a contribution is rounded to the nearest step and halves up") {
  RoundingCounts counts;
  CHECK(to_fixed(0x1p-32, counts) == 1);
  CHECK(to_fixed(0x1p-33, counts) == 1);
  CHECK(to_fixed(0x1.fffp-34, counts) == 0);
  CHECK(to_fixed(0x1.8p-32, counts) == 2);
  CHECK(to_fixed(-0.0, counts) == 0);
}

TEST_CASE("a pixel is the mean over its rays") {
  Film film(2, 1, 4);
  const std::int64_t one = std::int64_t{1} << 32;
  for (int i = 0; i < 4; ++i) film.add(1, {one, one / 2, i * one});
  const Picture picture = film.develop();
  CHECK(picture.width == 2);
  CHECK(picture.height == 1);
  CHECK(picture.rgb == std::vector<float>{0, 0, 0, 1, 0.5f, 1.5f});
}

TEST_CASE("a mean is rounded to float once, as the exact quotient would be") {
  const std::int64_t one = std::int64_t{1} << 32;
  CHECK(developed(one, 9) == 1.0f / 9.0f);
  CHECK(developed(one, 4096) == 0x1p-12f);
  CHECK(developed(1, 1) == 0x1p-32f);
  // Halfway between 1 and the next float, which rounds to even. One part in 3 · 2^62 more rounds
  // up: rounding to double on the way would lose that part.
  const std::int64_t halfway = (one << 24) + one;
  CHECK(developed(halfway, 1) == 0x1p24f);
  CHECK(developed(halfway + 1, 1) == 0x1.000002p24f);
  CHECK(developed(-halfway - 1, 1) == -0x1.000002p24f);
  Film film(1, 1, 3);
  for (int i = 0; i < 3; ++i) film.add(0, {halfway << 5, 0, 0});
  CHECK(film.develop().rgb[0] == 0x1p29f);
  film.add(0, {1, 0, 0});
  CHECK(film.develop().rgb[0] == 0x1.000002p29f);
}

TEST_CASE("random means agree with long division in extended precision") {
  std::mt19937_64 engine(5);
  for (int i = 0; i < 20000; ++i) {
    const std::int64_t fixed = static_cast<std::int64_t>(engine() >> (1 + engine() % 62));
    const auto rays = static_cast<std::uint32_t>(1 + engine() % 4096);
    const long double exact = static_cast<long double>(fixed) / rays / 4294967296.0L;
    CAPTURE(i, fixed, rays);
    // Half a unit of a float's last place, and a little for the reference's own rounding.
    CHECK(std::fabs(developed(fixed, rays) - exact) <= exact * 0x1.000001p-24L);
  }
}

TEST_CASE("every mean has the bits of exact arithmetic, whatever the sum's size and the rays") {
  std::mt19937_64 engine(6);
  constexpr std::uint32_t kSide = 64;
  for (const std::uint32_t rays : {1u, 2u, 4u, 9u, 16u, 25u, 49u, 64u, 4096u, 65025u, 1u << 31,
                                   std::numeric_limits<std::uint32_t>::max()}) {
    Film film(kSide, kSide, rays);
    std::vector<Wide> sums(3 * kSide * kSide);
    for (int round = 0; round < 12; ++round) {
      for (std::uint32_t pixel = 0; pixel < kSide * kSide; ++pixel) {
        // Some pixels receive once, others until their sums leave 64 bits; some of these come back.
        if (round > 0 && pixel % 4 < 2) continue;
        const FixedRgb light{random_fixed(engine), random_fixed(engine), random_fixed(engine)};
        film.add(pixel, light);
        sums[3 * pixel] += light.r;
        sums[3 * pixel + 1] += light.g;
        sums[3 * pixel + 2] += light.b;
      }
      if (round != 0 && round != 1 && round != 11) continue;
      const Picture picture = film.develop();
      for (std::size_t i = 0; i < sums.size(); ++i) {
        const float expected = slow_mean(sums[i], rays);
        if (std::bit_cast<std::uint32_t>(picture.rgb[i]) == std::bit_cast<std::uint32_t>(expected))
          continue;
        CAPTURE(rays, round, i, picture.rgb[i], expected);
        FAIL("another mean");
      }
    }
  }
}

TEST_CASE("the ends of 64 bits are developed exactly") {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  for (const std::uint32_t rays : {1u, 3u, 16u}) {
    for (const std::int64_t first : {kMost, kLeast, std::int64_t{0}, std::int64_t{-1}}) {
      for (const std::int64_t second : {kMost, kLeast, std::int64_t{0}, std::int64_t{1}}) {
        CAPTURE(rays, first, second);
        Film film(1, 1, rays);
        film.add(0, {0, 0, first});
        film.add(0, {0, 0, second});
        CHECK(film.develop().rgb[2] == slow_mean(Wide{first} + second, rays));
        film.clear(0);
        film.add(0, {0, 0, 1});
        CHECK(film.develop().rgb[2] == slow_mean(1, rays));
      }
    }
  }
}

TEST_CASE("sums beyond 64 bits are kept") {
  Film film(1, 1, 1);
  for (int i = 0; i < 8; ++i) film.add(0, {std::numeric_limits<std::int64_t>::max(), 0, 0});
  CHECK(film.develop().rgb[0] == 0x1p34f);
}

TEST_CASE("a cleared pixel forgets its light and its neighbours keep theirs") {
  Film film(3, 1, 1);
  const std::int64_t one = std::int64_t{1} << 32;
  for (std::uint32_t pixel = 0; pixel < 3; ++pixel) film.add(pixel, {one, one, one});
  film.clear(1);
  CHECK(film.develop().rgb == std::vector<float>{1, 1, 1, 0, 0, 0, 1, 1, 1});
}

TEST_CASE("AOVs are set, never summed, and forgotten with their pixel") {
  AovSet aovs;
  aovs.add(Aov::kObject);
  Film film(2, 1, 4, aovs);
  CHECK(film.has_slot(1));
  CHECK_FALSE(film.has_slot(aov_slot(kNormalPlane, 2, 0)));
  CHECK_FALSE(film.has_slot(8));
  const std::uint32_t slot = aov_slot(kDepthPlane, 2, 1);
  REQUIRE(film.has_slot(slot));
  film.add(slot, {0x40000000, 7, 0});
  film.add(1, {1, 1, 1});
  const Picture picture = film.develop();
  const std::uint32_t infinity = 0x7F800000;
  CHECK(picture.aovs == aovs);
  CHECK(picture.aov_planes[kDepthPlane] ==
        std::vector<std::uint32_t>{infinity, 0, 0, 0x40000000, 7, 0});
  CHECK(picture.aov_planes[kNormalPlane].empty());
  film.clear(1);
  CHECK(film.develop().aov_planes[kDepthPlane] ==
        std::vector<std::uint32_t>{infinity, 0, 0, infinity, 0, 0});
}

TEST_CASE("AOVs' names are read in any order, each at most once") {
  CHECK(parse_aovs("")->bits() == 0);
  CHECK(to_string(*parse_aovs("object,depth")) == "depth,object");
  CHECK(*parse_aovs("depth,normal,albedo,object") == AovSet::all());
  for (const char* wrong : {",", "depth,", ",depth", "depth,depth", "Depth", "depth normal", "z"}) {
    INFO(wrong);
    CHECK_FALSE(parse_aovs(wrong));
  }
}
