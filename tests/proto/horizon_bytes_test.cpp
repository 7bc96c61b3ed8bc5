// Light horizons over the wire.
#include "proto/horizon_bytes.hpp"

#include <algorithm>

#include "catch.hpp"
#include "proto/random.hpp"

using namespace graycube;
using namespace graycube::test;

namespace {

LightHorizons some_horizons() {
  Random random(7);
  HorizonMap map{0.125, std::vector<std::uint16_t>(LightHorizons::kTexels)};
  for (std::uint16_t& d : map.units) d = static_cast<std::uint16_t>(random.below(1000));
  map.units.front() = HorizonMap::kNever;
  LightDepths depths;
  depths.split = 3;
  depths.unit = 0.25;
  depths.clearance = 1e-3;
  depths.blocks = {0, 77, LightHorizons::kTexels - 1};
  for (std::size_t i = 0; i < depths.blocks.size() * 3 * 3; ++i)
    depths.lit.push_back(static_cast<std::uint16_t>(random.below(0x10000)));
  for (std::size_t i = 0; i < depths.blocks.size() * 6 * 6; ++i)
    depths.dark.push_back(static_cast<std::uint16_t>(random.below(0x10000)));
  return LightHorizons({map, {}, map}, {{}, {}, depths});
}

/// Bytes of a map: unit, one run's two lengths, and all distances but the first, which never comes.
constexpr std::size_t kMapBytes = 8 + 4 + 2 * (LightHorizons::kTexels - 1);
/// Offsets of the first light's map, and of the third light's depths.
constexpr std::size_t kMapAt = kHorizonHeaderBytes + 1;
constexpr std::size_t kDepthsAt = kHorizonHeaderBytes + 3 + 2 * kMapBytes + 1;

}  // namespace

TEST_CASE("horizons arrive as they were sent") {
  const LightHorizons sent = some_horizons();
  const auto received = decode_horizons(encode_horizons(sent), 3);
  REQUIRE(received);
  CHECK(received->maps() == sent.maps());
  CHECK(received->depths() == sent.depths());
  CHECK(decode_horizons(encode_horizons(LightHorizons{}), 0));
}

TEST_CASE("bytes that are no horizons are refused") {
  auto bytes = encode_horizons(some_horizons());
  CHECK_FALSE(decode_horizons(bytes, 2));
  CHECK_FALSE(decode_horizons({}, 0));
  for (const std::size_t size :
       {std::size_t{5}, std::size_t{12}, bytes.size() / 2, bytes.size() - 1}) {
    CHECK_FALSE(decode_horizons(std::span(bytes).first(size), 3));
  }
  auto longer = bytes;
  longer.push_back({});
  CHECK_FALSE(decode_horizons(longer, 3));
  for (const std::size_t at : {0u, 4u, 8u, 12u}) {  // magic, side, lights, whether there is a map
    auto broken = bytes;
    broken[at] ^= std::byte{0x42};
    CHECK_FALSE(decode_horizons(broken, 3));
  }
  // The values changed are split, unit, clearance, the number of blocks, and their order.
  for (const auto& [at, value] : {std::pair{0, 0},
                                  {0, 33},
                                  {0, 4},
                                  {8, 0x80},
                                  {16, 0x80},
                                  {17, 0},
                                  {17, 2},
                                  {17, 4},
                                  {20, 0x60},
                                  {25, 0},
                                  {32, 1}}) {
    INFO("byte " << at << " becomes " << value);
    auto broken = bytes;
    REQUIRE(broken[kDepthsAt] == std::byte{3});
    broken[kDepthsAt + static_cast<std::size_t>(at)] = std::byte(value);
    CHECK_FALSE(decode_horizons(broken, 3));
  }
  // The unit becomes NaN, negative, and 0.
  for (const auto& [at, value] : {std::pair{7, 0x7F}, {7, 0xBF}, {7, 0x00}}) {
    auto broken = bytes;
    broken[kMapAt + static_cast<std::size_t>(at)] = std::byte(value);
    if (value == 0x7F) broken[kMapAt + 6] = std::byte{0xF8};
    if (value == 0x00) std::fill_n(broken.begin() + kMapAt, 8, std::byte{0});
    CHECK_FALSE(decode_horizons(broken, 3));
  }
  // A run that is too long, and one of nothing.
  for (const int at : {8, 10}) {
    auto broken = bytes;
    broken[kMapAt + static_cast<std::size_t>(at) + 1] = std::byte{0xFF};
    CHECK_FALSE(decode_horizons(broken, 3));
  }
  auto broken = bytes;
  std::fill_n(broken.begin() + kMapAt + 8, 4, std::byte{0});
  CHECK_FALSE(decode_horizons(broken, 3));
}

TEST_CASE("horizons with random bytes changed are refused, or are horizons") {
  const auto good = encode_horizons(some_horizons());
  std::size_t refused = 0, read = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    INFO("seed " << seed);
    Random random(seed);
    auto bytes = good;
    // Mostly near the beginning, where lengths are.
    for (std::uint64_t i = 0; i <= random.below(3); ++i) {
      bytes[random.below(random.below(2) == 0 ? 64 : bytes.size())] = std::byte(random.below(256));
    }
    if (random.below(4) == 0) bytes.resize(random.below(bytes.size()));
    const auto received = decode_horizons(bytes, 3);
    ++(received ? read : refused);
    // Horizons that were read can be written, and read again.
    if (received) REQUIRE(decode_horizons(encode_horizons(*received), 3));
  }
  CHECK(refused > 50);
  CHECK(read > 50);
}

TEST_CASE("a map in which nothing ever comes takes few bytes") {
  const HorizonMap empty{1, std::vector<std::uint16_t>(LightHorizons::kTexels, HorizonMap::kNever)};
  const LightHorizons sent({empty});
  const auto bytes = encode_horizons(sent);
  CHECK(bytes.size() < 40);
  const auto received = decode_horizons(bytes, 1);
  REQUIRE(received);
  CHECK(received->maps() == sent.maps());
}
