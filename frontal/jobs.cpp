#include "frontal/jobs.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "frontal/parts/picture_answers.hpp"
#include "frontal/parts/submission.hpp"

namespace graycube {
namespace {

/// A job at whose beginning so many frontals in a row have died fails, so that it can't bring down
/// one after another for ever.
constexpr std::uint32_t kMaxBegins = 5;
/// Seconds after which it is asked again which ended jobs aren't to be kept any longer.
constexpr double kClearInterval_s = 10;
/// Seconds after which it is looked again how far the job has got.
constexpr double kLookInterval_s = 0.05;

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

Jobs::Jobs(const FrontalOptions& farm, JobStore& store, Post& post)
    : farm_(farm), store_(store), post_(post), ended_(store) {
  if (!ended_.all().empty()) queue_.number_beyond(ended_.all().back().info.job);
  queue_.number_beyond(store.last_number());
  recover_accepted();
}

QueuedJob Jobs::queued(control::JobInfo info, const control::JobOptions& options) const {
  QueuedJob job;
  job.submitted_at_s = now_.now_s;
  job.work.job = info.job;
  job.work.scene_name = info.scene;
  job.work.options = options;
  job.work.cube = farm_.cube;
  job.work.replica_bytes = farm_.replica_bytes;
  job.info = std::move(info);
  return job;
}

void Jobs::count(control::FarmInfo& farm) const {
  farm.queued = static_cast<std::uint32_t>(queue_.all().size());
  farm.running = running_ ? 1 : 0;
  farm.ended = static_cast<std::uint32_t>(ended_.all().size());
}

void Jobs::check_time() {
  if (running_ && running_->is_overdue(now_.now_s)) {
    fail({JobState::kFailed,
          FailureCode::kTimeout,
          {{"--timeout", "the render did not end in time"}}});
  }
  if (running_ && running_->has_lost_patience(now_.now_s)) fail(*running_->deadlock());
  if (running_ && now_.now_s - looked_s_ >= kLookInterval_s) {
    looked_s_ = now_.now_s;
    progress_watch_.see(running_->info(), running_->stage(), now_.now_s);
  }
  if (watchers_.are_due(now_.now_s)) tell_progress();
  if (running_) record_tiles(false);
  if (now_.now_s - cleared_s_ >= kClearInterval_s) {
    cleared_s_ = now_.now_s;
    ended_.clear_old(now_.unix_s);
  }
}

// ---- asked by clients

Answer Jobs::submit(const control::Submit& m, std::span<const std::byte> scene) {
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

// ---- its preparation

std::optional<PreparationWork> Jobs::take_work() {
  if (running_ || queue_.is_empty()) return std::nullopt;
  QueuedJob next = queue_.take_first();
  // Its client has waited since it was submitted to an earlier frontal.
  if (next.is_recovered)
    next.submitted_at_s = now_.now_s - std::max(0.0, now_.unix_s - next.info.submitted_s);
  running_.emplace(farm_, next, now_, cpu_);
  tell_progress();
  try {
    if (next.is_recovered) next.work.scene = store_.scene(next.info.job);
    const auto [begun, ever] = store_.begin(next.info.job);
    running_->goes_on_after(ever - 1);
    if (begun > kMaxBegins) {
      fail({JobState::kFailed,
            FailureCode::kFailed,
            {{"the frontal", "has died " + std::to_string(begun - 1) +
                                 " times as soon as this job began; it isn't tried again"}}});
      return std::nullopt;
    }
  } catch (const std::runtime_error& e) {
    fail({JobState::kFailed, FailureCode::kFailed, {{"the job store", e.what()}}});
    return std::nullopt;
  }
  return std::move(next.work);
}

void Jobs::give_result(PreparationResult result) {
  if (!running_ || running_->id() != result.job) return;  // cancelled meanwhile
  if (result.scene) {
    running_->prepared(*std::move(result.scene));
    return resume();
  }
  const FailureCode code = result.is_internal ? FailureCode::kFailed : FailureCode::kBadInput;
  fail({JobState::kFailed, code, std::move(result.errors)});
}

void Jobs::give_result(const RecutResult& cut) {
  if (!running_ || running_->id() != cut.job) return;  // the job ended meanwhile
  if (auto failure = running_->on_recut(cut, post_)) fail(*std::move(failure));
}

void Jobs::load() {
  running_->load(now_.now_s, post_);
  tell_progress();
}

// ---- told by nodes

void Jobs::on_node(Rank rank, const control::Ready& m) {
  if (running_) running_->on_ready(rank, m);
}

void Jobs::start(std::vector<std::uint32_t> incarnations) {
  running_->start(std::move(incarnations), now_.now_s, post_);
  running_->look_at_boundaries(now_.now_s, post_);
  tell_progress();
  finish_when_complete();
}

void Jobs::on_light(Rank from, std::span<const std::byte> batch) {
  if (!running_ || running_->stage() != JobStage::kRendering) return;
  if (auto failure = running_->on_light(from, batch, post_)) return fail(*std::move(failure));
  running_->look_at_boundaries(now_.now_s, post_);
  finish_when_complete();
}

void Jobs::on_node(Rank rank, const control::Pong& m) {
  if (running_) running_->on_pong(rank, m, now_.now_s);
}

void Jobs::on_node(Rank rank, const control::EpochAck& m) {
  if (running_) running_->on_epoch_ack(rank, m, post_);
}

void Jobs::on_node(Rank, const control::TokenRound& m) {
  if (is_rendered() && running_->on_round(m)) tell_progress();
}

void Jobs::on_node(Rank, const control::Terminated& m) {
  if (!is_rendered()) return;
  running_->on_terminated(m);
  finish_when_complete();
}

void Jobs::on_node(Rank, const control::NodeReport& m) {
  if (!is_rendered()) return;
  running_->on_report(m);
  end_when_over();
}

void Jobs::on_node(Rank rank, const control::NodeError& m) {
  if (!is_rendered()) return;
  if (auto failure = running_->on_error(rank, m, post_)) return fail(*std::move(failure));
  finish_when_complete();
}

void Jobs::on_node(Rank rank, const control::Borrow& m) {
  if (is_rendered()) running_->on_borrow(rank, m, post_);
}

void Jobs::on_node(Rank rank, const control::Share& m) {
  if (is_rendered()) running_->on_share(rank, m, post_);
}

void Jobs::on_node(Rank rank, const control::Worked& m) {
  if (!is_rendered()) return;
  running_->on_worked(rank, m, post_);
  running_->look_at_boundaries(now_.now_s, post_);
}

void Jobs::on_node(Rank rank, const control::Slid& m) {
  if (!is_rendered()) return;
  running_->on_slid(rank, m, now_.now_s, post_);
  running_->look_at_boundaries(now_.now_s, post_);
}

void Jobs::on_wait_report(Rank rank, const control::WaitReport& m, std::uint64_t last_ping) {
  if (is_rendered()) running_->on_wait_report(rank, m, last_ping, now_.now_s, post_);
}

bool Jobs::fail_internally(const std::string& why) {
  if (!running_) return false;
  const std::string scene = running_->info().scene;
  fail({JobState::kFailed, FailureCode::kFailed, {{scene, "internal error: " + why}}});
  return true;
}

// ---- how jobs get on and end

void Jobs::tell_progress() {
  if (running_) watchers_.tell(running_->progress_at(now_.now_s), now_.now_s, post_);
}

void Jobs::finish_when_complete() {
  if (auto failure = running_->finish_when_complete(now_.now_s, post_))
    return fail(*std::move(failure));
  end_when_over();
}

void Jobs::end_when_over() {
  if (!running_->is_over()) return;
  running_->deadlock() ? fail(*running_->deadlock()) : complete();
}

void Jobs::complete() {
  Picture picture = running_->picture();
  EndedJob job{running_->info(), running_->statistics(now_.now_s, cpu_, {}), false};
  running_.reset();
  job.info.state = JobState::kDone;
  job.info.finished_s = now_.unix_s;
  job.info.fraction = 1;
  const EndedJob& kept = ended_.keep(std::move(job), std::move(picture));
  for (const PeerId& peer : watchers_.take(kept.info.job)) {
    if (kept.info.state == JobState::kDone) {
      post_.to_peer(peer, control::Done{kept.info.job, {kept.stats_json}});
    } else {
      post_.answer(
          peer, Refusal{kept.info.job, FailureCode::kFailed, "the job store", kept.info.message});
    }
  }
}

/// The nodes drop the job. A job that is deadlocked ends as deadlocked, whatever else happens while
/// it waits for reports.
void Jobs::fail(JobFailure failure) {
  if (running_->is_loaded()) post_.to_nodes(control::Finish{running_->id()});
  // How far it came is told of it, but not how long the rest would have taken.
  EndedJob job{running_->info_at(now_.now_s), "{}", false};
  job.info.eta_s.reset();
  if (running_->deadlock()) {
    failure = *running_->deadlock();
    job.stats_json = running_->statistics(now_.now_s, cpu_, failure.errors.front().why);
    job.is_deadlocked = true;
  }
  running_.reset();
  end(std::move(job), std::move(failure));
}

void Jobs::end(EndedJob job, JobFailure failure) {
  job.info.state = failure.state;
  job.info.finished_s = now_.unix_s;
  if (!failure.errors.empty()) {
    const control::ErrorItem& first = failure.errors.front();
    job.info.message = (first.where.empty() ? "" : first.where + ": ") + first.why;
  }
  control::Failed failed{job.info.job, failure.code, std::move(failure.errors), {}};
  if (job.has_stats()) failed.stats = RawObject{job.stats_json};
  for (const PeerId& peer : watchers_.take(failed.job)) post_.to_peer(peer, failed);
  ended_.keep(std::move(job), {});
}

}  // namespace graycube
