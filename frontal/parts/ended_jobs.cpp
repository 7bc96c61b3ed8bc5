#include "frontal/parts/ended_jobs.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace graycube {

EndedJobs::EndedJobs(JobStore& store) : store_(store) {
  for (EndedJob& job : store_.recover()) list(std::move(job));
}

const EndedJob& EndedJobs::keep(EndedJob job, Picture picture) {
  try {
    store_.keep(job, std::move(picture));
  } catch (const std::runtime_error& e) {
    job.info.message = e.what();
    if (job.info.state == JobState::kDone) job.info.state = JobState::kFailed;
  }
  return list(std::move(job));
}

const EndedJob& EndedJobs::list(EndedJob job) {
  jobs_.push_back(std::move(job));
  if (jobs_.size() > kMaxEndedJobs) jobs_.pop_front();
  return jobs_.back();
}

const EndedJob* EndedJobs::find(std::uint32_t job) const {
  const auto at = std::ranges::find(jobs_, job, [](const EndedJob& j) { return j.info.job; });
  if (at != jobs_.end()) return &*at;
  try {
    old_ = store_.ended(job);
  } catch (const std::runtime_error&) {
    old_.reset();
  }
  return old_ ? &*old_ : nullptr;
}

void EndedJobs::clear_old(double unix_s) {
  try {
    for (const std::uint32_t job : store_.clear_old(unix_s))
      std::erase_if(jobs_, [job](const EndedJob& j) { return j.info.job == job; });
  } catch (const std::runtime_error&) {
    // They are cleared another time, when the disk takes changes again.
  }
}

}  // namespace graycube
