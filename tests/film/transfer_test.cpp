#include "film/transfer.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "catch.hpp"

using namespace graycube;

namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

double srgb_by_the_library(double v) {
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

}  // namespace

TEST_CASE("16-bit samples follow the rule floor(65535 clamp(v) + 0.5)") {
  CHECK(linear_16_bit(0) == 0);
  CHECK(linear_16_bit(1) == 65535);
  CHECK(linear_16_bit(0.5f) == 32768);
  CHECK(linear_16_bit(0.4999f) == 32761);
  CHECK(linear_16_bit(0.49f / 65535) == 0);
  CHECK(linear_16_bit(0.51f / 65535) == 1);
  CHECK(linear_16_bit(7) == 65535);
  CHECK(linear_16_bit(-3) == 0);
}

TEST_CASE("broken numbers become black or white, never anything else") {
  CHECK(linear_16_bit(std::nanf("")) == 0);
  CHECK(srgb_8_bit(std::nanf("")) == 0);
  CHECK(linear_16_bit(kInf) == 65535);
  CHECK(srgb_8_bit(kInf) == 255);
  CHECK(linear_16_bit(-kInf) == 0);
  CHECK(srgb_8_bit(-kInf) == 0);
}

TEST_CASE("well-known sRGB values come out") {
  CHECK(srgb_8_bit(0) == 0);
  CHECK(srgb_8_bit(1) == 255);
  CHECK(srgb_8_bit(0.5f) == 188);
  CHECK(srgb_8_bit(0.18f) == 118);
  CHECK(srgb_8_bit(0.2158605f) == 128);
  CHECK(srgb_8_bit(0.0030353f) == 10);  // on the straight piece
  CHECK(srgb_8_bit(0.0001f) == 0);
  CHECK(srgb_8_bit(0.0002f) == 1);
}

TEST_CASE("sRGB samples of floats in order are in order, and step where the formula does") {
  // Every step lies between two neighbouring floats; on both sides of each the formula agrees.
  std::uint32_t below = 0;
  for (int code = 1; code <= 255; ++code) {
    auto reached = std::bit_cast<std::uint32_t>(1.0f);
    std::uint32_t low = below;
    while (reached - low > 1) {
      const std::uint32_t middle = low + (reached - low) / 2;
      (srgb_8_bit(std::bit_cast<float>(middle)) >= code ? reached : low) = middle;
    }
    CAPTURE(code);
    const auto at = std::bit_cast<float>(reached), before = std::bit_cast<float>(reached - 1);
    CHECK(int{srgb_8_bit(at)} == code);
    CHECK(int{srgb_8_bit(before)} == code - 1);
    CHECK(255 * srgb_by_the_library(at) + 0.5 >= code - 1e-9);
    CHECK(255 * srgb_by_the_library(before) + 0.5 < code + 1e-9);
    below = reached;
  }
}

TEST_CASE("every sRGB sample is the formula's, rounded") {
  for (int i = 0; i <= 200000; ++i) {
    const float v = static_cast<float>(i) / 200000;
    const double exact = 255 * srgb_by_the_library(v);
    CAPTURE(v);
    REQUIRE(std::fabs(srgb_8_bit(v) - exact) <= 0.5 + 1e-9);
  }
}
