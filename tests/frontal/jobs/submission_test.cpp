#include "frontal/admission/submission.hpp"

#include "catch.hpp"
#include "csg/random_model.hpp"
#include "proto/model_slice.hpp"
#include "scene/compile_scene.hpp"

using namespace graycube;

namespace {

std::optional<FailureCode> refused(const control::Submit& m, std::span<const std::byte> scene,
                                   bool is_private = false) {
  const auto refusal = refusal_of(m, scene, is_private);
  return refusal ? std::optional(refusal->code) : std::nullopt;
}

}  // namespace

TEST_CASE(
    "a scene is taken whatever is in it: what is wrong with it shows "
    "when it is read") {
  CHECK_FALSE(refused({"a scene", {}}, Bytes(10)));
}

TEST_CASE("a scene beyond the limit is not taken") {
  const Bytes largest(kMaxSubmitBytes + 1);
  CHECK(refused({}, largest) == FailureCode::kTooLarge);
  CHECK_FALSE(refused({}, std::span(largest).first(kMaxSubmitBytes)));
}

TEST_CASE("serial is nothing for a farm") {
  control::Submit m;
  m.options.algorithm = Algorithm::kSerial;
  CHECK(refused(m, Bytes(10)) == FailureCode::kBadRequest);
}

TEST_CASE("only a private frontal takes scenes that its client has compiled") {
  const Bytes compiled = encode_model(compile_scene(testing::RandomModel(3).scene()));
  CHECK(refused({}, compiled) == FailureCode::kBadInput);
  CHECK_FALSE(refused({}, compiled, true));
}
