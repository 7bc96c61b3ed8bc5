// How pictures of jobs get into the store and out of it, beside the mailroom.
#include <utility>

#include "frontal/jobs.hpp"

namespace graycube {

std::optional<KeepingWork> Jobs::take_keeping() {
  if (!film_) return std::nullopt;
  return KeepingWork{keeping_->info, std::exchange(film_, nullptr), &store_};
}

/// The picture is on the disk before the job counts as done: without it the job would be rendered
/// again.
void Jobs::give_result(KeepingResult result) {
  if (!keeping_ || keeping_->info.job != result.job) return;
  EndedJob job = *std::exchange(keeping_, std::nullopt);
  job.info.state = result.error.empty() ? JobState::kDone : JobState::kFailed;
  job.info.message = std::move(result.error);
  job.info.finished_s = now_.unix_s;
  const EndedJob& kept = ended_.keep(std::move(job), std::move(result.picture));
  log_.job_ends(kept.info);
  for (const PeerId& peer : watchers_.take(kept.info.job)) {
    if (kept.info.state == JobState::kDone) {
      post_.to_peer(peer, control::Done{kept.info.job, {kept.stats_json}});
    } else {
      post_.answer(
          peer, Refusal{kept.info.job, FailureCode::kFailed, "the job store", kept.info.message});
    }
  }
}

bool Jobs::must_read(std::uint32_t job) const {
  const auto info = find(job);
  return info && info->state == JobState::kDone && store_.must_read(job);
}

void Jobs::give_result(ReadingResult result) {
  if (result.picture) store_.hold(result.job, *std::move(result.picture));
}

}  // namespace graycube
