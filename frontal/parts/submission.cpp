#include "frontal/parts/submission.hpp"

#include "proto/model_slice.hpp"

namespace graycube {

std::optional<Refusal> refusal_of(const control::Submit& m, std::span<const std::byte> scene,
                                  bool is_private) {
  if (scene.size() > kMaxSubmitBytes) {
    return Refusal{0, FailureCode::kTooLarge, "", "the scene is too large"};
  }
  if (m.options.algorithm == Algorithm::kSerial) {
    return Refusal{0, FailureCode::kBadRequest, "--algorithm",
                   "serial runs in the command itself, without a farm"};
  }
  if (is_encoded_model(scene) && !is_private) {
    return Refusal{0, FailureCode::kBadInput, m.scene_name,
                   "this farm compiles scenes itself: expected JSON or CBOR"};
  }
  return std::nullopt;
}

}  // namespace graycube
