// What clients may ask of jobs.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "frontal/jobs.hpp"
#include "frontal/parts/picture_answers.hpp"
#include "frontal/parts/submission.hpp"

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

Answer Jobs::submit(const control::Submit& m, std::span<const std::byte> scene) {
  Answer answer = accept(m, scene);
  if (const auto* refusal = std::get_if<Refusal>(&answer)) {
    log_.submission_is_refused(
        m.scene_name, (refusal->where.empty() ? "" : refusal->where + ": ") + refusal->why);
  }
  return answer;
}

Answer Jobs::accept(const control::Submit& m, std::span<const std::byte> scene) {
  if (auto refusal = refusal_of(m, scene, farm_.is_private)) return *std::move(refusal);
  const std::uint64_t content = content_of(m, scene);
  try {
    if (const auto known = m.key.empty() ? std::nullopt : store_.find_key(m.key)) {
      if (known->content == content) return Reply{control::Accepted{known->job}};
      return Refusal{known->job, FailureCode::kBadRequest, "key",
                     "another scene or other options were submitted under this key"};
    }
    if (auto refusal = refusal_for_want_of_room(queue_)) return *std::move(refusal);
    control::JobInfo info;
    info.job = queue_.next_number();
    info.scene = m.scene_name;
    info.algorithm = m.options.algorithm;
    info.nodes = farm_.cube.nodes();
    info.submitted_s = now_.unix_s;
    // The number is told only once the store has it: it must be the job's after any end of this
    // process.
    store_.add({info, m.options, m.key, content}, scene);
    log_.job_is_accepted(info, false);
    QueuedJob job = queued(std::move(info), m.options);
    job.work.scene.assign(scene.begin(), scene.end());
    job.content = content;
    return Reply{control::Accepted{queue_.add(std::move(job))}};
  } catch (const std::runtime_error& e) {
    return Refusal{0, FailureCode::kFailed, "the job store", e.what()};
  }
}

std::optional<control::JobInfo> Jobs::find(std::uint32_t job) const {
  if (running_ && running_->id() == job) return running_info();
  if (keeping_ && keeping_->info.job == job) return keeping_->info;
  if (const auto* queued = queue_.find(job)) {
    control::JobInfo info = *queued;
    if (running_) info.message = "waits for job " + std::to_string(running_->id()) + " to end";
    return info;
  }
  if (const EndedJob* ended = ended_.find(job)) return ended->info;
  return std::nullopt;
}

control::JobInfo Jobs::running_info() const {
  control::JobInfo info = running_->info_at(now_.now_s);
  info.message = "waits for " + progress_watch_.waits_for(info, running_->stage(), now_.now_s);
  return info;
}

Answer Jobs::status(std::uint32_t job) const {
  if (const auto info = find(job)) return Reply{*info};
  return unknown(job);
}

Answer Jobs::list() const {
  control::Jobs list;
  const auto has_room = [&] { return list.jobs.size() < kMaxJobsListed; };
  if (running_) list.jobs.push_back(running_info());
  if (keeping_) list.jobs.push_back(keeping_->info);
  for (const QueuedJob& job : queue_.all()) {
    if (has_room()) list.jobs.push_back(job.info);
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
