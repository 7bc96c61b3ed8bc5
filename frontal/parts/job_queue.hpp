// The jobs that wait for their turn, and the numbers that jobs get.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

#include "frontal/preparation/preparation.hpp"
#include "proto/messages.hpp"

namespace graycube {

inline constexpr std::size_t kMaxQueuedJobs = 1000;

struct QueuedJob {
  control::JobInfo info;
  PreparationWork work;
  /// Seconds on the frontal's clock.
  double submitted_at_s = 0;
  /// Digest of all that was asked for.
  std::uint64_t content = 0;
  /// An earlier frontal took it: its scene is still to be read from the store.
  bool is_recovered = false;
};

class JobQueue {
 public:
  /// Tells that number `job` has been used: later jobs get larger ones.
  void number_beyond(std::uint32_t job) {
    if (next_job_ != 0 && job >= next_job_) next_job_ = job + 1;
  }

  /// The largest number was used: no other job can be added.
  bool is_out_of_numbers() const { return next_job_ == 0; }
  bool is_full() const { return jobs_.size() >= kMaxQueuedJobs; }
  bool is_empty() const { return jobs_.empty(); }
  /// The number that the next job will get.
  std::uint32_t next_number() const { return next_job_; }
  /// Returns the number that the job gets. The queue must not be full, nor out of numbers.
  std::uint32_t add(QueuedJob job) {
    job.info.job = job.work.job = next_job_++;
    jobs_.push_back(std::move(job));
    return jobs_.back().info.job;
  }
  /// Takes up a job that an earlier frontal has numbered.
  void restore(QueuedJob job) {
    number_beyond(job.info.job);
    jobs_.push_back(std::move(job));
  }
  /// Takes the job that was added first. The queue must not be empty.
  QueuedJob take_first() {
    QueuedJob first = std::move(jobs_.front());
    jobs_.pop_front();
    return first;
  }
  std::optional<QueuedJob> remove(std::uint32_t job) {
    const auto at = std::ranges::find(jobs_, job, number_of);
    if (at == jobs_.end()) return std::nullopt;
    QueuedJob removed = std::move(*at);
    jobs_.erase(at);
    return removed;
  }

  /// Null if no such job waits. Valid until the queue changes.
  const control::JobInfo* find(std::uint32_t job) const {
    const auto at = std::ranges::find(jobs_, job, number_of);
    return at == jobs_.end() ? nullptr : &at->info;
  }
  const std::deque<QueuedJob>& all() const { return jobs_; }

 private:
  static std::uint32_t number_of(const QueuedJob& job) { return job.info.job; }

  std::deque<QueuedJob> jobs_;
  std::uint32_t next_job_ = 1;
};

}  // namespace graycube
