// How models are written into slices, and read back.
#include "proto/model_slice.hpp"

#include "catch.hpp"
#include "fuzz/proto_fuzz.hpp"
#include "proto/bytes.hpp"
#include "proto/model_samples.hpp"

using namespace graycube;
using namespace graycube::test;

TEST_CASE("any model comes back equal, and bit for bit the same when encoded again") {
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    INFO("seed " << seed);
    const Model model = some_model(seed);
    const Bytes bytes = encode_model(model);
    CHECK(bytes.size() == encoded_model_bytes(model));
    const auto result = decode_model(bytes);
    if (const auto* error = std::get_if<ModelError>(&result))
      FAIL(error->where << ": " << error->why);
    CHECK(std::get<Model>(result) == model);
    // Equality takes −0 for +0; the bytes don't.
    CHECK(encode_model(std::get<Model>(result)) == bytes);
  }
}

TEST_CASE("a model without solids, lights or materials comes back") {
  Model model;
  model.settings = small_model().settings;
  const auto result = decode_model(encode_model(model));
  REQUIRE(std::holds_alternative<Model>(result));
  CHECK(std::get<Model>(result) == model);
}

TEST_CASE("a sphere takes 87 bytes: no matrix, no planes") {
  Model model = small_model();
  const std::size_t before = encoded_model_bytes(model);
  model.primitives.push_back(model.primitives[0]);
  CHECK(encoded_model_bytes(model) - before == 7 + 4 * 8 + 6 * 8);
}

TEST_CASE("the header of a model slice lies at the offsets that FORMAT.md gives") {
  const Bytes bytes = encode_model(small_model());
  CHECK(std::memcmp(bytes.data(), "GCM1", 4) == 0);
  CHECK(load_little<std::uint16_t>(bytes.data() + 4) == kModelVersion);
  const std::uint32_t counts[] = {0, 1, 2, 2, 6, 2, 1};
  for (std::size_t i = 0; i < 7; ++i)
    CHECK(load_little<std::uint32_t>(bytes.data() + 8 + 4 * i) == counts[i]);
  CHECK(load_little<std::uint32_t>(bytes.data() + 36) == 4);
  CHECK(load_little<std::uint32_t>(bytes.data() + 40) == 3);
  CHECK(load_little<double>(bytes.data() + 52 + 16) == -5);
  // Settings end at 224; a material of 82 bytes, two planes, a mesh of three points, two triangles
  // and a plane, then the first primitive.
  const std::byte* mesh = bytes.data() + 224 + 82 + 64;
  CHECK(load_little<std::uint32_t>(mesh) == 3);
  CHECK(load_little<std::uint32_t>(mesh + 4) == 2);
  CHECK(load_little<std::uint32_t>(mesh + 8) == 1);
  CHECK(load_little<double>(mesh + 12 + 24) == 1);
  CHECK(load_little<std::uint32_t>(mesh + 12 + 72 + 4) == 1);
  CHECK(load_little<double>(mesh + 12 + 72 + 24 + 16) == 1);
  CHECK(load_little<std::uint32_t>(mesh + 12 + 72 + 24 + 32) == TriangleMesh::kOwnPlane);
  CHECK(load_little<std::uint32_t>(mesh + 12 + 72 + 24 + 32 + 4) == 0);
  const std::byte* primitive = mesh + 12 + 72 + 24 + 32 + 8;
  CHECK(load_little<std::uint8_t>(primitive) == 0);
  CHECK(load_little<std::uint16_t>(primitive + 1) == (0x0F | 0x80));
  CHECK(load_little<double>(primitive + 7 + 24) == 0.5);
}

TEST_CASE("a model cut anywhere is refused, and so is one with a byte too many") {
  Bytes bytes = encode_model(small_model());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    CHECK_FALSE(fuzz_model(std::span(bytes).first(size)));
  }
  bytes.push_back(std::byte{0});
  CHECK(error_of(bytes).where == "end");
}

TEST_CASE("mutated models are refused or survive a round trip") {
  int accepted = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    const Bytes bytes = encode_model(some_model(seed));
    Random random(seed);
    for (int i = 0; i < 100; ++i) {
      INFO("seed " << seed << ", mutation " << i);
      accepted += fuzz_model(test::mutated(bytes, random)) ? 1 : 0;
    }
  }
  CHECK(accepted > 1000);
}
