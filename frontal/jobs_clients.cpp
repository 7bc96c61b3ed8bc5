// What clients may ask of jobs.
#include <algorithm>
#include <utility>

#include "frontal/jobs.hpp"
#include "frontal/parts/picture_answers.hpp"

namespace graycube {
namespace {

Refusal unknown(std::uint32_t job) { return {job, FailureCode::kUnknownJob, "", "no such job"}; }

/// The message that tells clients that a job has ended, and how.
ControlMessage end_of(const EndedJob& job) {
  if (job.info.state == JobState::kDone) return control::Done{job.info.job, {job.stats_json}};
  FailureCode code = FailureCode::kFailed;
  if (job.info.state == JobState::kCancelled) code = FailureCode::kCancelled;
  if (job.is_deadlocked) code = FailureCode::kDeadlock;
  control::Failed failed{job.info.job, code, {{"", job.info.message}}, {}};
  if (job.has_stats()) failed.stats = RawObject{job.stats_json};
  return failed;
}

}  // namespace

std::optional<control::JobInfo> Jobs::find(std::uint32_t job) const {
  if (running_ && running_->id() == job) return running_info();
  if (keeping_.is_on() && keeping_.job()->job == job) return *keeping_.job();
  if (const auto* queued = queue_.find(job)) return queued_info(*queued);
  if (const EndedJob* ended = ended_.find(job)) return ended->info;
  return std::nullopt;
}

control::JobInfo Jobs::running_info() const {
  control::JobInfo info = running_->info_at(now_.now_s);
  info.message = "waits for " + progress_watch_.waits_for(info, running_->stage(), now_.now_s);
  return info;
}

control::JobInfo Jobs::queued_info(control::JobInfo job) const {
  if (running_) {
    job.message = "waits for job " + std::to_string(running_->id()) + " to end";
  } else if (const control::JobInfo* kept = keeping_.job()) {
    job.message = "waits for job " + std::to_string(kept->job) + "'s picture to be kept";
  }
  return job;
}

Answer Jobs::status(std::uint32_t job) const {
  if (const auto info = find(job)) return Reply{*info};
  return unknown(job);
}

Answer Jobs::list() const {
  control::Jobs list;
  const auto has_room = [&] { return list.jobs.size() < kMaxJobsListed; };
  if (running_) list.jobs.push_back(running_info());
  if (keeping_.is_on()) list.jobs.push_back(*keeping_.job());
  for (const QueuedJob& job : queue_.all()) {
    if (has_room()) list.jobs.push_back(queued_info(job.info));
  }
  for (auto job = ended_.all().rbegin(); job != ended_.all().rend() && has_room(); ++job)
    list.jobs.push_back(job->info);
  std::ranges::sort(list.jobs, {}, &control::JobInfo::job);
  return Reply{std::move(list)};
}

Answer Jobs::watch(const PeerId& peer, std::uint32_t job) {
  const EndedJob* ended = ended_.find(job);
  if (ended != nullptr) return Reply{end_of(*ended)};
  const auto info = find(job);
  if (!info) return unknown(job);
  watchers_.add(job, peer);
  const bool is_on = running_ && running_->id() == job;
  return Reply{is_on ? running_->progress_at(now_.now_s) : progress_of(*info)};
}

Answer Jobs::cancel(std::uint32_t job) {
  const JobFailure cancelled{JobState::kCancelled, FailureCode::kCancelled, {{"", "cancelled"}}};
  if (running_ && running_->id() == job) {
    fail(cancelled);
  } else if (auto queued = queue_.remove(job)) {
    end({std::move(queued->info), "{}", false}, cancelled);
  } else if (find(job)) {
    return Refusal{job, FailureCode::kBadRequest, "", "the job has ended already"};
  }
  return status(job);
}

std::variant<const Picture*, Refusal> Jobs::picture(std::uint32_t job) {
  const auto info = find(job);
  if (!info) return unknown(job);
  if (info->state != JobState::kDone) {
    return Refusal{job, FailureCode::kNotDone, "",
                   "the job is " + std::string(to_string(info->state))};
  }
  if (const Picture* picture = ended_.picture(job)) return picture;
  return Refusal{job, FailureCode::kFailed, "", "the picture is not kept any longer"};
}

bool Jobs::must_read(std::uint32_t job) const {
  const auto info = find(job);
  return info && info->state == JobState::kDone && store_.must_read(job);
}

void Jobs::give_result(ReadingResult result) {
  if (result.picture) store_.hold(result.job, *std::move(result.picture));
}

Answer Jobs::fetch(const control::Fetch& m) {
  const auto found = picture(m.job);
  if (const auto* refusal = std::get_if<Refusal>(&found)) return *refusal;
  return picture_rows(*std::get<const Picture*>(found), m);
}

/// The picture need not go through sockets: the client that asks has started this frontal, and
/// could write the files itself.
std::variant<WritingWork, Refusal> Jobs::write(const control::Write& m) {
  if (!farm_.is_private) {
    return Refusal{m.job, FailureCode::kBadRequest, "type", "only a private frontal writes files"};
  }
  const auto found = picture(m.job);
  if (const auto* refusal = std::get_if<Refusal>(&found)) return *refusal;
  return WritingWork{{}, m, std::get<const Picture*>(found), {find(m.job)->scene, farm_.version}};
}

}  // namespace graycube
