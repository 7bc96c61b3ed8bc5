// The newest jobs that have ended, and their pictures as far as the store still has them.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "frontal/parts/job_store.hpp"

namespace graycube {

inline constexpr std::size_t kMaxEndedJobs = kMaxJobsListed;

class EndedJobs {
 public:
  /// Takes up what an earlier frontal left. The store must outlive this.
  explicit EndedJobs(JobStore& store);

  /// Stores and lists a job. One that can't be stored has failed, and says why. Returns it as it is
  /// listed; valid until the next call.
  const EndedJob& keep(EndedJob job, Picture picture);

  /// Null if there is no such job. Valid until the next call of anything here.
  const EndedJob* find(std::uint32_t job) const;
  /// Null when it isn't kept (any longer). Valid until the next call of anything here.
  const Picture* picture(std::uint32_t job) { return store_.picture(job); }
  /// The listed jobs, the oldest first.
  const std::deque<EndedJob>& all() const { return jobs_; }
  /// Clears jobs that the store keeps no longer at that Unix time, at most some at a time.
  void clear_old(double unix_s);

 private:
  const EndedJob& list(EndedJob job);

  JobStore& store_;
  std::deque<EndedJob> jobs_;
  /// The job that find() has found in the store, since it is too old to be listed.
  mutable std::optional<EndedJob> old_;
};

}  // namespace graycube
