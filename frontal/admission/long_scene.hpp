// Long scenes that are to become jobs: slow work, which is done beside the mailroom.
#pragma once

#include <cstdint>
#include <string>

#include "frontal/parts/job_store.hpp"
#include "proto/messages.hpp"
#include "transport/message.hpp"

namespace graycube {

/// A scene is to be told apart from others, and written to the store.
struct AdmissionWork {
  control::Submit request;
  SharedBytes scene;
  /// The job that it is written for; 0 if it isn't, as there is one under its key already.
  std::uint32_t job = 0;
  /// Must outlive the work.
  JobStore* store = nullptr;
};

struct AdmissionResult {
  /// content_of() the submission.
  std::uint64_t content = 0;
  /// Why the scene could not be written; empty if it was.
  std::string error;
};

/// Any thread may call it, one at a time.
AdmissionResult admit_scene(const AdmissionWork& work);

}  // namespace graycube
