// What a slice may not say of outlines.
#include "proto/model_slice.hpp"

#include "catch.hpp"
#include "proto/bytes.hpp"
#include "proto/model_samples.hpp"

using namespace graycube;
using namespace graycube::test;

TEST_CASE("a broken outline is refused, and the error names the part") {
  const BrokenModel changes[] = {
      {"primitive 1", "outline", [](Model& m) { m.primitives[1].outline = 1; }},
      {"primitive 0", "outline", [](Model& m) { m.primitives[0].kind = PrimitiveKind::kLathe; }},
      {"outline 0", "empty", [](Model& m) { m.outlines = {Outline(OutlineLoops{})}; }},
      {"outline 0", "segments",
       [](Model& m) {
         m.outlines = {Outline(OutlineLoops{{{0, 0}, {0, 1}, {1, 1}}, {}})};
       }},
      {"outline 0", "range",
       [](Model& m) {
         m.outlines = {Outline(OutlineLoops{{{0, 0}, {0, 1.5}, {1, 1}}})};
       }},
      {"outline 0", "range",
       [](Model& m) {
         m.outlines = {Outline(OutlineLoops{{{0, 0}, {0, std::nan("")}, {1, 1}}})};
       }},
  };
  check_refusals(changes);
}

TEST_CASE("an outline's counts are checked") {
  Model model = small_model();
  model.meshes.clear();
  model.outlines = {Outline(OutlineLoops{{{0, 0}, {0, 1}, {1, 1}}})};
  model.primitives[0].kind = PrimitiveKind::kSweep;
  const Bytes good = encode_model(model);
  REQUIRE(decode_model(good).index() == 0);
  CHECK(load_little<std::uint16_t>(good.data() + 6) == 1);
  constexpr std::size_t kOutline = 224 + 82 + 64;
  const auto why_with = [&](std::size_t at, std::uint32_t value) {
    Bytes bytes = good;
    store_little(bytes.data() + kOutline + at, value);
    const ModelError error = error_of(bytes);
    CHECK(error.where == "outline 0");
    return error.why;
  };
  CHECK(why_with(0, 0) == "empty");
  CHECK(why_with(0, kMaxOutlineSegments + 1) == "a count beyond its limit");
  CHECK(why_with(4, 0) == "a loop without segments");
  CHECK(why_with(4, kMaxOutlineSegments) == "too short");
  CHECK(why_with(4, kMaxOutlineSegments + 1) == "a count beyond its limit");
}
