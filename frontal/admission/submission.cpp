#include "frontal/admission/submission.hpp"

#include "content_digest.hpp"
#include "proto/control.hpp"
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

std::optional<Refusal> refusal_for_want_of_room(const JobQueue& queue) {
  if (queue.is_full()) {
    return Refusal{0, FailureCode::kBusy, "",
                   "the queue is full (" + std::to_string(kMaxQueuedJobs) + " jobs)"};
  }
  if (queue.is_out_of_numbers()) {
    return Refusal{0, FailureCode::kFailed, "the job store",
                   "all numbers of jobs are used; begin with another folder"};
  }
  return std::nullopt;
}

Refusal farm_goes_down() { return {0, FailureCode::kBusy, "", "the farm is going down"}; }

std::uint64_t content_of(const control::Submit& m, std::span<const std::byte> scene) {
  control::Submit asked = m;
  asked.key.clear();
  return ContentDigest().add(encode(asked)).add(scene).value();
}

}  // namespace graycube
