// Meshes on their way between programs.
#include "formats/mesh/part_stream.hpp"

#include <random>

#include "catch.hpp"
#include "fuzz/part_stream_fuzz.hpp"
#include "mesh/samples.hpp"

using namespace graycube;
using namespace graycube::testing;

namespace {

std::string example() {
  std::vector<MeshPart> parts{{"a ring", ring_polygons(3, 1, 4, 3), std::array{1.0, 0.5, 0.0, 1.0}},
                              {"", box_polygons({0, 0, 0}, {1, 2, 3}), std::nullopt}};
  parts[0].polygons.digits = 7;
  return encode_parts(parts);
}

std::string why(const std::string& bytes) {
  const auto read = decode_parts(bytes);
  const auto* fault = std::get_if<MeshFault>(&read);
  return fault == nullptr ? "" : fault->why;
}

}  // namespace

TEST_CASE("parts arrive as they were sent") {
  const auto read = decode_parts(example());
  const auto& parts = std::get<std::vector<MeshPart>>(read);
  REQUIRE(parts.size() == 2);
  CHECK(parts[0].name == "a ring");
  CHECK(parts[0].polygons.digits == 7);
  CHECK(parts[0].polygons.points == ring_polygons(3, 1, 4, 3).points);
  CHECK(parts[1].polygons.corners == box_polygons({0, 0, 0}, {1, 2, 3}).corners);
  REQUIRE(parts[0].color);
  CHECK((*parts[0].color)[1] == 0.5);
  CHECK_FALSE(parts[1].color);
  CHECK(encode_parts(parts) == example());
  CHECK(why(encode_parts(MeshFault{"no more"})) == "no more");
}

TEST_CASE("parts that are cut off or longer than they say are refused") {
  const std::string whole = example();
  for (std::size_t size = 0; size < whole.size(); ++size)
    CHECK(!why(whole.substr(0, size)).empty());
  CHECK(!why(whole + "x").empty());
}

TEST_CASE("whatever happens to parts on their way, they are sound or refused") {
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    INFO("seed " << seed);
    std::mt19937 random(seed);
    std::string bytes = example();
    for (unsigned n = 1 + static_cast<unsigned>(random() % 3); n > 0; --n)
      bytes[random() % bytes.size()] = static_cast<char>(random());
    fuzz_part_stream(bytes);
  }
}
