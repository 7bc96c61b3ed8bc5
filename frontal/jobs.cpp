#include "frontal/jobs.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace graycube {
namespace {

/// A job at whose beginning so many frontals in a row have died fails, so that it can't bring down
/// one after another for ever.
constexpr std::uint32_t kMaxBegins = 5;
/// Seconds after which it is asked again which ended jobs aren't to be kept any longer.
constexpr double kClearInterval_s = 10;
/// Seconds after which it is looked again how far the job has got.
constexpr double kLookInterval_s = 0.05;

}  // namespace

Jobs::Jobs(const FrontalOptions& farm, JobStore& store, Post& post, FarmLog& log)
    : farm_(farm), store_(store), post_(post), log_(log), ended_(store) {
  if (!ended_.all().empty()) queue_.number_beyond(ended_.all().back().info.job);
  queue_.number_beyond(store.last_number());
  recover_accepted();
}

void Jobs::count(control::FarmInfo& farm) const {
  farm.queued = static_cast<std::uint32_t>(queue_.all().size());
  farm.running = running_ || keeping_.is_on() ? 1 : 0;
  farm.ended = static_cast<std::uint32_t>(ended_.all().size());
}

void Jobs::count(control::FarmMetrics& farm) const {
  farm.counts = log_.counts();
  if (!running_) return;
  farm.counts.tiles_whole += running_->tiles_made();
  farm.fraction = running_->progress_at(now_.now_s).fraction;
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
    if (progress_watch_.take_stands(now_.now_s)) {
      log_.job_stands(running_->id(),
                      progress_watch_.waits_for(running_->info(), running_->stage(), now_.now_s));
    }
  }
  if (watchers_.are_due(now_.now_s)) tell_progress();
  if (running_) record_tiles(false);
  if (now_.now_s - cleared_s_ >= kClearInterval_s) {
    cleared_s_ = now_.now_s;
    ended_.clear_old(now_.unix_s);
  }
}

// ---- its preparation

std::optional<PreparationWork> Jobs::take_work() {
  if (running_ || keeping_.is_on() || queue_.is_empty()) return std::nullopt;
  QueuedJob next = queue_.take_first();
  // The farm may have got another size since the job was accepted.
  next.work.cube = farm_.cube;
  next.info.nodes = farm_.cube.nodes();
  next.work.hosts = farm_.hosts;
  // Its client has waited since it was submitted to an earlier frontal.
  if (next.is_recovered)
    next.submitted_at_s = now_.now_s - std::max(0.0, now_.unix_s - next.info.submitted_s);
  running_.emplace(farm_, next, now_, cpu_, log_);
  tell_progress();
  try {
    if (next.is_recovered) find_scene(next.work);
    const auto [begun, ever] = store_.begin(next.info.job);
    running_->goes_on_after(ever - 1);
    log_.job_begins(next.info, ever - 1);
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

/// Long scenes are read by whoever prepares them.
void Jobs::find_scene(PreparationWork& work) {
  if (auto scene = store_.scene(work.job)) {
    work.scene = *std::move(scene);
  } else {
    work.read_scene = [this, job = work.job]() -> SharedBytes { return store_.read_scene(job); };
  }
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

// ---- what nodes' losses do to the job that is on (docs/design/epochs.md)

void Jobs::nodes_were_lost(const std::vector<NodeLoss>& nodes) {
  if (!running_) {
    for (const NodeLoss& node : nodes)
      log_.node_is_lost(node.rank, node.name, node.how, node.noticed_s);
    return;
  }
  if (auto failure = running_->lose(nodes, post_)) return fail(*std::move(failure));
  if (running_->is_loaded()) finish_when_complete();
}

void Jobs::node_has_host(const NodeLoss& node) {
  if (running_) running_->note_guest(node);
}

void Jobs::look_for_lost_messages() {
  if (!running_) return;
  if (auto failure = running_->look_for_lost_messages(now_.now_s, post_))
    return fail(*std::move(failure));
  if (running_->is_loaded()) finish_when_complete();
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

std::string Jobs::take_statistics(const std::string& failed) {
  log_.nodes_reported(running_->node_stats(), running_->slice_bytes());
  return running_->statistics(now_.now_s, cpu_, failed);
}

void Jobs::complete() {
  EndedJob job{running_->info(), take_statistics({}), false};
  log_.tiles_were_made(running_->tiles_made());
  keeping_.begin(std::move(job), running_->take_film());
  running_.reset();
}

void Jobs::give_result(KeepingResult result) {
  auto job = keeping_.end(result, now_.unix_s);
  if (!job) return;
  const EndedJob& kept = ended_.keep(*std::move(job), std::move(result.picture));
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

/// The nodes drop the job. A job that is deadlocked ends as deadlocked, whatever else happens while
/// it waits for reports.
void Jobs::fail(JobFailure failure) {
  if (running_->is_loaded()) post_.to_nodes(control::Finish{running_->id()});
  // How far it came is told of it, but not how long the rest would have taken.
  EndedJob job{running_->info_at(now_.now_s), "{}", false};
  job.info.eta_s.reset();
  if (running_->deadlock()) {
    failure = *running_->deadlock();
    job.stats_json = take_statistics(failure.errors.front().why);
    job.is_deadlocked = true;
  }
  log_.tiles_were_made(running_->tiles_made());
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
  log_.job_ends(job.info);
  control::Failed failed{job.info.job, failure.code, std::move(failure.errors), {}};
  if (job.has_stats()) failed.stats = RawObject{job.stats_json};
  for (const PeerId& peer : watchers_.take(failed.job)) post_.to_peer(peer, failed);
  ended_.keep(std::move(job), {});
}

}  // namespace graycube
