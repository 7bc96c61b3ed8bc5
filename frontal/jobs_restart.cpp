// How jobs go from one frontal to the next: what it takes up, records, and leaves.
#include <stdexcept>
#include <utility>

#include "frontal/jobs.hpp"

namespace graycube {

void Jobs::recover_accepted() {
  for (AcceptedJob& accepted : store_.recover_accepted()) {
    control::JobInfo info = std::move(accepted.info);
    info.state = JobState::kQueued;
    info.nodes = farm_.cube.nodes();
    log_.job_is_accepted(info, true);
    QueuedJob job = queued_job(farm_, std::move(info), accepted.options, now_);
    job.is_recovered = true;
    job.content = accepted.content;
    queue_.restore(std::move(job));
  }
}

void Jobs::resume() {
  if (!farm_.records_tiles) return;
  if (!running_->resume(store_.recorded_tiles(running_->id()))) store_.forget_tiles(running_->id());
}

void Jobs::record_tiles(bool all) {
  for (;;) {
    Bytes records = running_->take_records(now_.now_s, all);
    if (records.empty()) return;
    try {
      store_.record_tiles(running_->id(), std::move(records));
    } catch (const std::runtime_error&) {
      return;  // they would be traced again
    }
    // The rest can wait for the next time, so that others are answered in between.
    if (!all) return;
  }
}

void Jobs::stop() {
  admission_.close(post_);
  if (running_) record_tiles(true);
  if (farm_.keeps_jobs) return leave_to_next_frontal();
  const JobFailure stopped{JobState::kCancelled, FailureCode::kCancelled, {{"", "the farm stops"}}};
  if (running_) fail(stopped);
  while (!queue_.is_empty()) end({queue_.take_first().info, "{}", false}, stopped);
}

void Jobs::leave_to_next_frontal() {
  const auto tell = [this](std::uint32_t job) {
    for (const PeerId& peer : watchers_.take(job)) post_.to_peer(peer, control::Bye{});
  };
  if (running_) {
    if (running_->is_loaded()) post_.to_nodes(control::Finish{running_->id()});
    tell(running_->id());
    running_.reset();
  }
  while (!queue_.is_empty()) tell(queue_.take_first().info.job);
}

}  // namespace graycube
