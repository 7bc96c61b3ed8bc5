// The job that is complete, as long as its picture isn't kept: it counts as rendered, and no other
// begins.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "frontal/parts/keeping.hpp"

namespace graycube {

class PictureKeeping {
 public:
  /// No other picture must be on its way to the store.
  void begin(EndedJob job, Film film) {
    job_ = std::move(job);
    job_->info.fraction = 1;
    job_->info.message = "waits for its picture to be written";
    film_ = std::make_shared<const Film>(std::move(film));
  }
  bool is_on() const { return job_.has_value(); }
  /// Null if none is on. Valid until the next call.
  const control::JobInfo* job() const { return job_ ? &job_->info : nullptr; }

  /// What is to be done, once.
  std::optional<KeepingWork> take_work(JobStore& store) {
    if (!film_) return std::nullopt;
    return KeepingWork{job_->info, std::exchange(film_, nullptr), &store};
  }
  /// The job as it has ended at that Unix time: without its picture it would have to be rendered
  /// again. Nothing if the result is none of the job's.
  std::optional<EndedJob> end(const KeepingResult& result, double unix_s) {
    if (!job_ || job_->info.job != result.job) return std::nullopt;
    EndedJob job = *std::exchange(job_, std::nullopt);
    job.info.state = result.error.empty() ? JobState::kDone : JobState::kFailed;
    job.info.message = result.error;
    job.info.finished_s = unix_s;
    return job;
  }

 private:
  std::optional<EndedJob> job_;
  /// Until it is taken.
  std::shared_ptr<const Film> film_;
};

}  // namespace graycube
