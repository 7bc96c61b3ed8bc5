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
};

class JobQueue {
 public:
  /// Tells that number `job` has been used: later jobs get larger ones.
  void number_beyond(std::uint32_t job) { next_job_ = std::max(next_job_, job + 1); }

  bool is_full() const { return jobs_.size() >= kMaxQueuedJobs; }
  bool is_empty() const { return jobs_.empty(); }
  /// Returns the number that the job gets. The queue must not be full.
  std::uint32_t add(QueuedJob job) {
    job.info.job = job.work.job = next_job_++;
    jobs_.push_back(std::move(job));
    return jobs_.back().info.job;
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
