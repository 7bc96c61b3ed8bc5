// A job's way through the frontal: prepared, loaded, rendered, kept.
#include <algorithm>
#include <stdexcept>
#include <utility>

#include "frontal/frontal.hpp"
#include "proto/control.hpp"
#include "proto/statistics.hpp"

namespace graycube {

std::optional<PreparationWork> Frontal::take_work() {
  start_next_job();
  if (!running_ || !running_->is_preparing || queue_.empty() ||
      queue_.front().info.job != running_->info.job) {
    return std::nullopt;
  }
  PreparationWork work = std::move(queue_.front().work);
  queue_.pop_front();
  return work;
}

void Frontal::start_next_job() {
  if (running_ || queue_.empty() || going_down_) return;
  const QueuedJob& next = queue_.front();
  Running& job = running_.emplace(Running{});
  job.info = next.info;
  job.options = next.work.options;
  job.submitted_at_s = next.submitted_at_s;
  job.began_at_s = now_s_;
  job.is_preparing = true;
  if (job.info.job > 1) {
    job.cpu_at_start_s = cpu_seconds();
    job.start_cpu_at_start_s = start_cpu_seconds();
  }
  job.info.state = JobState::kLoading;
  job.info.started_s = unix_s_;
  report_progress(true);
}

void Frontal::give_result(PreparationResult result) {
  if (!running_ || running_->info.job != result.job) return;  // cancelled meanwhile
  running_->is_preparing = false;
  if (!result.scene) {
    return end_job(JobState::kFailed, FailureCode::kBadInput, std::move(result.errors));
  }
  std::uint32_t threads =
      running_->options.threads != 0 ? running_->options.threads : options_.threads;
  if (result.scene->flow == FlowMode::kBlocking) {
    threads = 1;
    running_->deadlocks.emplace(options_.cube);
  }
  running_->info.choices = choices_text(*result.scene);
  if (running_->options.sums == SumsMode::kTree) running_->info.choices += ", sums by tree";
  running_->render.emplace(result.job, std::move(*result.scene), options_.cube, threads,
                           options_.limits, running_->options.sums);
  running_->info.algorithm = running_->render->scene().algorithm;
  running_->info.tiles = static_cast<std::uint32_t>(running_->render->tiles());
  load_when_possible();
}

void Frontal::load_when_possible() {
  if (!running_ || !running_->render || running_->is_loaded || !all_nodes_here()) return;
  running_->is_loaded = true;
  running_->build_began_s = now_s_;
  running_->info.state = JobState::kBuilding;
  const std::string load = encode(running_->render->load());
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) {
    outgoing_.push_back(
        {nodes_[rank].peer, Message::of_text(load, running_->render->take_slice(Rank{rank}))});
  }
  report_progress(true);
}

void Frontal::start_rendering() {
  running_->is_started = true;
  running_->render_began_s = now_s_;
  running_->info.state = JobState::kRendering;
  control::Start m;
  m.job = running_->render->id();
  m.epoch = running_->render->epoch();
  for (const NodeRecord& n : nodes_) m.incarnations.push_back(n.incarnation);
  send_to_nodes(m);
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) hand_out(Rank{rank});
  report_progress(true);
  finish_when_complete();
}

void Frontal::hand_out(Rank rank) {
  RenderJob& render = *running_->render;
  const auto tiles = render.next_tiles(rank);
  if (tiles.empty()) return;
  const BatchStamp stamp{render.id(), render.epoch(), kFrontalRank, 0,
                         render.next_assignment_sequence(rank)};
  outgoing_.push_back(
      {nodes_[rank.value].peer, Message::of_batch(encode_assignment(stamp, tiles))});
}

void Frontal::on_contributions(std::span<const std::byte> batch) {
  if (!running_ || !running_->is_started || running_->is_finishing) return;
  const auto header = peek_header(batch);
  if (const auto* h = std::get_if<BatchHeader>(&header);
      h != nullptr && h->stamp.job != running_->render->id()) {
    return;
  }
  std::vector<Rank> opened;
  const std::string wrong = running_->render->add_contributions(batch, opened);
  if (!wrong.empty()) {
    return end_job(JobState::kFailed, FailureCode::kFailed, {{"the frontal", wrong}});
  }
  std::sort(opened.begin(), opened.end());
  opened.erase(std::unique(opened.begin(), opened.end()), opened.end());
  for (const Rank rank : opened) hand_out(rank);
  const std::vector<std::uint32_t> relief = running_->render->take_relief();
  for (std::uint32_t rank = 0; rank < relief.size(); ++rank) {
    if (relief[rank] == 0) continue;
    send(nodes_[rank].peer,
         control::Relieved{running_->render->id(), running_->render->epoch(), relief[rank]});
  }
  const bool were_whole = running_->info.tiles_whole == running_->info.tiles;
  running_->info.tiles_whole = static_cast<std::uint32_t>(running_->render->tiles_whole());
  if (!were_whole && running_->info.tiles_whole == running_->info.tiles &&
      !running_->render->is_roth()) {
    send(nodes_.front().peer, control::AllWhole{running_->render->id(), running_->render->epoch()});
  }
  finish_when_complete();
}

void Frontal::lend(Rank rank, const control::Borrow& m) {
  const RenderJob& render = *running_->render;
  if (!render.is_meant(m) || running_->is_finishing) return;
  const SharedBytes* slice = render.slice_to_lend(m.rank);
  const bool fits = slice != nullptr && slice->size() <= m.room_bytes;
  send(nodes_[rank.value].peer, control::Lend{m.job, m.epoch, m.rank},
       fits ? *slice : SharedBytes{});
}

void Frontal::share(Rank owner, const control::Share& m) {
  RenderJob& render = *running_->render;
  if (!render.is_meant(m) || running_->is_finishing || !options_.cube.has(Rank{m.rank})) return;
  const SharedBytes* slice = render.slice_to_copy(owner, Rank{m.rank});
  if (slice != nullptr)
    send(nodes_[m.rank].peer, control::Copy{m.job, m.epoch, owner.value}, *slice);
}

void Frontal::watch_for_deadlock(Rank rank, const control::WaitReport& m) {
  const RenderJob& render = *running_->render;
  if (!running_->deadlocks || !render.is_meant(m) || running_->is_finishing) return;
  const std::vector<Rank> cycle = running_->deadlocks->add(rank, m, pings_);
  if (cycle.empty()) return;
  std::string way;
  for (const Rank r : cycle) way += "node " + std::to_string(r.value) + " waits for ";
  running_->deadlock = "deadlock: " + way + "node " + std::to_string(cycle.front().value) +
                       ", each for room in a full queue; " +
                       std::to_string(running_->deadlocks->stalled()) + " of " +
                       std::to_string(options_.cube.nodes()) + " nodes are blocked";
  running_->is_finishing = true;
  running_->render_ended_s = now_s_;
  send_to_nodes(control::Finish{render.id()});
}

void Frontal::end_as_deadlocked() {
  end_job(JobState::kFailed, FailureCode::kDeadlock, {{"--flow blocking", running_->deadlock}});
}

void Frontal::finish_when_complete() {
  const std::string wrong = running_->render->contradiction();
  if (!wrong.empty()) {
    return end_job(JobState::kFailed, FailureCode::kFailed, {{"the frontal", wrong}});
  }
  if (!running_->render->is_complete() || running_->is_finishing) return;
  running_->is_finishing = true;
  running_->render_ended_s = now_s_;
  send_to_nodes(control::Finish{running_->render->id()});
}

void Frontal::complete() {
  Picture picture = running_->render->film().develop();
  running_->info.state = JobState::kDone;
  running_->info.finished_s = unix_s_;
  running_->info.fraction = 1;
  EndedJob job{running_->info, statistics(), false};
  running_.reset();
  keep(std::move(job), std::move(picture));
}

/// Ends the running job without a picture; the nodes drop it. One that is deadlocked ends as that,
/// whatever else happens while it waits for reports.
void Frontal::end_job(JobState state, FailureCode code, std::vector<control::ErrorItem> errors) {
  if (running_->is_loaded) send_to_nodes(control::Finish{running_->info.job});
  EndedJob job{running_->info, "{}", false};
  if (!running_->deadlock.empty()) {
    state = JobState::kFailed;
    code = FailureCode::kDeadlock;
    job.is_deadlocked = true;
    errors = {{"--flow blocking", running_->deadlock}};
    job.stats_json = statistics(running_->deadlock);
  }
  if (running_->is_preparing && !queue_.empty() && queue_.front().info.job == job.info.job) {
    queue_.pop_front();
  }
  running_.reset();
  job.info.state = state;
  job.info.finished_s = unix_s_;
  if (!errors.empty()) {
    job.info.message =
        (errors.front().where.empty() ? "" : errors.front().where + ": ") + errors.front().why;
  }
  control::Failed failed{job.info.job, code, std::move(errors), {}};
  if (job.has_stats()) failed.stats = RawObject{job.stats_json};
  for (const PeerId& peer : watchers_[job.info.job]) send(peer, failed);
  watchers_.erase(job.info.job);
  keep(std::move(job), {});
}

void Frontal::keep(EndedJob job, Picture picture) {
  try {
    store_.keep(job, std::move(picture));
  } catch (const std::runtime_error& e) {
    job.info.message = e.what();
    if (job.info.state == JobState::kDone) job.info.state = JobState::kFailed;
  }
  const auto watchers = std::exchange(watchers_[job.info.job], {});
  watchers_.erase(job.info.job);
  for (const PeerId& peer : watchers) {
    if (job.info.state == JobState::kDone) {
      send(peer, control::Done{job.info.job, {job.stats_json}});
    } else {
      refuse(peer, job.info.job, FailureCode::kFailed, "the job store", job.info.message);
    }
  }
  ended_.push_back(std::move(job));
  if (ended_.size() > kMaxEndedJobs) ended_.pop_front();
}

/// `failed`: why there is no picture.
std::string Frontal::statistics(const std::string& failed) const {
  const RenderJob& render = *running_->render;
  Statistics s;
  s.failed = failed;
  s.version = options_.version;
  s.scene = running_->info.scene;
  s.algorithm = render.scene().algorithm;
  s.nodes = options_.cube.nodes();
  s.threads = render.threads();
  s.dimension = options_.cube.dimension();
  s.grid = {options_.cube.columns(), options_.cube.rows()};
  s.scatter = render.scene().grid.scatter;
  s.shadows = render.scene().shadows;
  s.partition = render.scene().partition;
  s.flow = render.scene().flow;
  s.sums = render.sums();
  s.image = render.scene().settings.image;
  s.primitives = render.scene().primitives;
  s.objects = render.scene().objects;
  s.wall_s = now_s_ - running_->submitted_at_s;
  s.frontal_cpu_s = cpu_seconds() - running_->cpu_at_start_s;
  s.cpu_s = s.frontal_cpu_s;
  s.start_cpu_s = start_cpu_seconds() - running_->start_cpu_at_start_s;
  s.load_s = render.scene().load_s;
  s.partition_s = render.scene().partition_s;
  s.build_s = running_->render_began_s - running_->build_began_s;
  s.render_s = running_->render_ended_s - running_->render_began_s;
  s.token_rounds = render.rounds();
  s.token_hops = render.hops();
  s.per_node = render.reports();
  for (const control::NodeStats& n : s.per_node) {
    s.cpu_s += n.cpu_s;
    s.start_cpu_s += n.start_cpu_s;
  }
  return statistics_json(s);
}

}  // namespace graycube
