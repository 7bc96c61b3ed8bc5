// Light horizons over the wire.
#include "proto/horizon_bytes.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "proto/random.hpp"

using namespace graycube;
using namespace graycube::test;

namespace {

LightHorizons some_horizons() {
  Random random(7);
  LightHorizons::Map map(LightHorizons::kTexels);
  for (float& d : map) d = static_cast<float>(random.below(1000));
  map.front() = std::numeric_limits<float>::infinity();
  return LightHorizons({map, {}, map});
}

}  // namespace

TEST_CASE("horizons arrive as they were sent") {
  const LightHorizons sent = some_horizons();
  const auto received = decode_horizons(encode_horizons(sent), 3);
  REQUIRE(received);
  CHECK(received->maps() == sent.maps());
  CHECK(decode_horizons(encode_horizons(LightHorizons{}), 0));
}

TEST_CASE("bytes that are no horizons are refused") {
  auto bytes = encode_horizons(some_horizons());
  CHECK_FALSE(decode_horizons(bytes, 2));
  CHECK_FALSE(decode_horizons({}, 0));
  for (const std::size_t size : {std::size_t{5}, std::size_t{12}, bytes.size() / 2, bytes.size() - 1}) {
    CHECK_FALSE(decode_horizons(std::span(bytes).first(size), 3));
  }
  auto longer = bytes;
  longer.push_back({});
  CHECK_FALSE(decode_horizons(longer, 3));
  for (const std::size_t at : {0, 4, 8, 12}) {  // magic, side, lights, whether there is a map
    auto broken = bytes;
    broken[at] ^= std::byte{0x42};
    CHECK_FALSE(decode_horizons(broken, 3));
  }
  for (const std::uint32_t bits : {0x7FC00000u, 0xBF800000u}) {  // no number, a negative one
    auto broken = bytes;
    for (int i = 0; i < 4; ++i) broken[17 + static_cast<std::size_t>(i)] = std::byte(bits >> (8 * i));
    CHECK_FALSE(decode_horizons(broken, 3));
  }
}
