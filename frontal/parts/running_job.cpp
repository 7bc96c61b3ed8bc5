#include "frontal/parts/running_job.hpp"

#include <algorithm>
#include <utility>

#include "proto/statistics.hpp"

namespace graycube {
namespace {

/// `is_again`: nodes have traced in an epoch before.
JobState state_of(JobStage stage, bool is_again) {
  switch (stage) {
    case JobStage::kPreparing:
    case JobStage::kPrepared: return JobState::kLoading;
    case JobStage::kBuilding: return is_again ? JobState::kRendering : JobState::kBuilding;
    case JobStage::kRendering:
    case JobStage::kReporting: break;
  }
  return JobState::kRendering;
}

JobFailure own_failure(std::string why) {
  return {JobState::kFailed, FailureCode::kFailed, {{"the frontal", std::move(why)}}};
}

std::string deadlock_text(const std::vector<Rank>& cycle, std::uint32_t blocked,
                          std::uint32_t nodes) {
  std::string way;
  for (const Rank r : cycle) way += "node " + std::to_string(r.value) + " waits for ";
  return "deadlock: " + way + "node " + std::to_string(cycle.front().value) +
         ", each for room in a full queue; " + std::to_string(blocked) + " of " +
         std::to_string(nodes) + " nodes are blocked";
}

}  // namespace

RunningJob::RunningJob(const FrontalOptions& farm, const QueuedJob& job, const Moment& now,
                       const CpuMeter& cpu, FarmLog& log)
    : farm_(farm),
      farm_log_(log),
      content_(job.content),
      info_(job.info),
      options_(job.work.options),
      standstill_watch_(farm.cube.nodes()) {
  times_.submitted_s = job.submitted_at_s;
  times_.began_s = now.now_s;
  info_.started_s = now.unix_s;
  if (info_.job > 1) cpu_before_ = {cpu.used_s(), cpu.starting_s()};
}

bool RunningJob::is_overdue(double now_s) const {
  return options_.timeout_s > 0 && now_s - times_.began_s > options_.timeout_s;
}

// ---- before it is rendered

void RunningJob::prepared(PreparedScene scene) {
  std::uint32_t threads = options_.threads != 0 ? options_.threads : farm_.threads;
  if (scene.flow == FlowMode::kBlocking) {
    threads = 1;
    deadlock_watch_.emplace(farm_.cube);
  }
  info_.choices = choices_text(scene);
  const SumsMode sums = sums_of(options_);
  if (sums != SumsMode::kDirect) info_.choices += ", sums by " + std::string(to_string(sums));
  info_.algorithm = scene.algorithm;
  render_.emplace(id(), std::move(scene), farm_.cube, threads, farm_.limits, sums, farm_.retries);
  info_.tiles = static_cast<std::uint32_t>(render_->tiles());
  stage_ = JobStage::kPrepared;
}

void RunningJob::load(double now_s, Post& post) {
  if (stage_ == JobStage::kPrepared) {
    stage_ = JobStage::kBuilding;
    times_.build_began_s = now_s;
  }
  const bool over_links = render_->slice_way().has_value();
  post.to_each_node(render_->load(), [&](Rank rank) -> std::optional<SharedBytes> {
    if (!render_->barrier().needs_load(rank)) return std::nullopt;
    render_->barrier().was_loaded(rank);
    return over_links && rank != Rank{0} ? SharedBytes{} : render_->slices().of(rank);
  });
}

bool RunningJob::waits_to_be_loaded() const {
  if (stage_ == JobStage::kPrepared) return true;
  return is_on_nodes() && render_->barrier().needs_load();
}

void RunningJob::on_epoch_ack(Rank rank, const control::EpochAck& m, Post& post) {
  if (!is_on_nodes() || !render_->is_meant(m)) return;
  render_->barrier().has_acknowledged(rank, m.epoch);
  const auto way = render_->slice_way();
  if (!way || stage_ != JobStage::kBuilding || !render_->knows_of_it(rank)) return;
  for (const Rank to : way->farthest_first()) {
    post.to_node(Rank{0}, control::HandOn{m.job, m.epoch, to.value}, render_->slices().of(to));
  }
}

void RunningJob::on_ready(Rank rank, const control::Ready& m) {
  if (!is_on_nodes() || m.job != id()) return;
  render_->is_ready(rank, m.epoch);
  if (stage_ == JobStage::kRendering) late_.push_back(rank);
}

bool RunningJob::can_start() const {
  if (stage_ == JobStage::kRendering) return !late_.empty();
  return stage_ == JobStage::kBuilding && render_->barrier().is_open();
}

void RunningJob::start(std::vector<std::uint32_t> incarnations, double now_s, Post& post) {
  const control::Start start{id(), render_->epoch(), std::move(incarnations),
                             render_->open_tiles()};
  if (stage_ == JobStage::kRendering) {
    for (const Rank rank : std::exchange(late_, {})) {
      post.to_node(rank, start);
      hand_out(rank, post);
    }
    return;
  }
  stage_ = JobStage::kRendering;
  standstill_watch_.begin();
  if (render_->epoch() == 0) {
    times_.render_began_s = now_s;
    log_.begin(now_s, has_records_ ? std::nullopt : std::optional(recorded_picture()));
  }
  post.to_nodes(start);
  for (std::uint32_t rank = 0; rank < farm_.cube.nodes(); ++rank) hand_out(Rank{rank}, post);
}

// ---- while it is rendered

void RunningJob::hand_out(Rank rank, Post& post) {
  if (!render_->barrier().can_trace(rank)) return;
  const auto tiles = render_->next_tiles(rank);
  if (tiles.empty()) return;
  const BatchStamp stamp{id(), render_->epoch(), kFrontalRank, 0,
                         render_->next_assignment_sequence(rank)};
  post.to_node(rank, encode_assignment(stamp, tiles));
}

std::optional<JobFailure> RunningJob::on_light(Rank from, std::span<const std::byte> batch,
                                               Post& post) {
  const auto header = peek_header(batch);
  const auto* h = std::get_if<BatchHeader>(&header);
  if (h != nullptr && h->stamp.job != id()) return std::nullopt;
  std::vector<Rank> opened;
  LightIntake::Taken taken = render_->add_contributions(batch, opened);
  if (taken.is_lost)
    return go_on_without({{"the frontal", {from.value, std::move(taken.wrong), 0, 0}}}, false,
                         post);
  if (!taken.wrong.empty()) return own_failure(std::move(taken.wrong));
  if (farm_.records_tiles) log_.note(taken.whole);
  std::sort(opened.begin(), opened.end());
  opened.erase(std::unique(opened.begin(), opened.end()), opened.end());
  for (const Rank rank : opened) hand_out(rank, post);
  const std::vector<std::uint32_t> relief = render_->take_relief();
  for (std::uint32_t rank = 0; rank < relief.size(); ++rank) {
    if (relief[rank] == 0) continue;
    post.to_node(Rank{rank}, control::Relieved{id(), render_->epoch(), relief[rank]});
  }
  const bool were_whole = info_.tiles_whole == info_.tiles;
  info_.tiles_whole = static_cast<std::uint32_t>(render_->tiles_whole());
  if (!were_whole && info_.tiles_whole == info_.tiles && !render_->is_roth()) {
    post.to_node(Rank{0}, control::AllWhole{id(), render_->epoch()});
  }
  return std::nullopt;
}

void RunningJob::on_borrow(Rank rank, const control::Borrow& m, Post& post) const {
  if (!render_->is_meant(m) || stage_ == JobStage::kReporting) return;
  const SharedBytes* slice = render_->slices().to_lend(m.rank);
  const bool fits = slice != nullptr && slice->size() <= m.room_bytes;
  post.to_node(rank, control::Lend{m.job, m.epoch, m.rank}, fits ? *slice : SharedBytes{});
}

void RunningJob::on_share(Rank owner, const control::Share& m, Post& post) {
  if (!render_->is_meant(m) || stage_ == JobStage::kReporting) return;
  if (!farm_.cube.has(Rank{m.rank})) return;
  const SharedBytes* slice = render_->slices().to_copy(owner, Rank{m.rank});
  if (slice == nullptr) return;
  post.to_node(Rank{m.rank}, control::Copy{m.job, m.epoch, owner.value}, *slice);
}

// ---- boundaries that slide

void RunningJob::look_at_boundaries(double now_s, Post& post) {
  Sliding* const sliding = this->sliding();
  if (sliding == nullptr) return;
  if (sliding->take_closed())
    post.to_nodes(control::Turn{id(), render_->epoch(), sliding->generation(), sliding->oldest()});
  if (sliding->all_handed_out() && !std::exchange(are_told_dealt_, true))
    post.to_nodes(control::Dealt{id(), render_->epoch()});
  sliding->look(now_s);
}

void RunningJob::on_worked(Rank rank, const control::Worked& m, Post& post) {
  if (sliding() == nullptr || !render_->is_meant(m)) return;
  sliding()->has_worked(rank, m);
  hand_out(rank, post);
}

std::optional<RecutWork> RunningJob::take_recut() {
  return sliding() != nullptr ? sliding()->take_recut() : std::nullopt;
}

std::optional<JobFailure> RunningJob::on_recut(const RecutResult& cut, Post& post) {
  if (sliding() == nullptr) return std::nullopt;
  if (!cut.error.empty()) return own_failure(cut.error);
  if (!sliding()->was_recut(cut)) return std::nullopt;
  post.to_each_node(sliding()->slide_message(render_->epoch()),
                    [&](Rank rank) { return cut.slices[rank.value]; });
  return std::nullopt;
}

void RunningJob::on_slid(Rank rank, const control::Slid& m, double now_s, Post& post) {
  if (sliding() == nullptr || !render_->is_meant(m) || !sliding()->is_held(rank, m, now_s)) return;
  post.to_nodes(
      control::Turn{id(), render_->epoch(), sliding()->generation(), sliding()->oldest()});
  render_->deal();
  for (std::uint32_t r = 0; r < farm_.cube.nodes(); ++r) hand_out(Rank{r}, post);
}

bool RunningJob::on_round(const control::TokenRound& m) {
  if (!render_->is_meant(m)) return false;
  render_->set_token({m.round, m.hops});
  info_.rounds = m.round;
  return true;
}

void RunningJob::on_terminated(const control::Terminated& m) {
  if (!render_->is_meant(m)) return;
  render_->set_terminated(m);
  render_->set_token({m.rounds, m.hops});
}

void RunningJob::on_wait_report(Rank rank, const control::WaitReport& m, std::uint64_t last_ping,
                                double now_s, Post& post) {
  if (!deadlock_watch_ || !render_->is_meant(m) || stage_ == JobStage::kReporting) return;
  const std::vector<Rank> cycle = deadlock_watch_->add(rank, m, last_ping);
  if (cycle.empty()) return;
  deadlock_ = JobFailure{
      JobState::kFailed,
      FailureCode::kDeadlock,
      {{"--flow blocking", deadlock_text(cycle, deadlock_watch_->stalled(), farm_.cube.nodes())}}};
  ask_for_reports(now_s, post);
}

// ---- its end

void RunningJob::ask_for_reports(double now_s, Post& post) {
  stage_ = JobStage::kReporting;
  times_.render_ended_s = now_s;
  // A node that has taken another's place, and was not loaded yet, has nothing to tell.
  for (std::uint32_t rank = 0; rank < farm_.cube.nodes(); ++rank) {
    if (render_->barrier().needs_load(Rank{rank})) render_->reports().will_not_come(Rank{rank});
  }
  post.to_nodes(control::Finish{id()});
}

std::optional<JobFailure> RunningJob::finish_when_complete(double now_s, Post& post) {
  std::string wrong = render_->contradiction();
  if (!wrong.empty()) return own_failure(std::move(wrong));
  const bool is_over = render_->is_complete() || (is_cut_short_ && is_on_nodes());
  if (is_over && stage_ != JobStage::kReporting) ask_for_reports(now_s, post);
  return std::nullopt;
}

void RunningJob::on_report(const control::NodeReport& m) {
  if (m.job == id()) render_->reports().add(m.stats);
}

bool RunningJob::is_over() const {
  return stage_ == JobStage::kReporting && render_->reports().are_complete();
}

bool RunningJob::has_lost_patience(double now_s) const {
  return deadlock_ && now_s - times_.render_ended_s > kReportPatience_s;
}

// ---- what is told of it

control::JobInfo RunningJob::info() const {
  control::JobInfo info = info_;
  info.state = state_of(stage_, times_.render_began_s > 0);
  return info;
}

control::JobInfo RunningJob::info_at(double now_s) const {
  control::JobInfo info = this->info();
  const control::Progress progress = progress_at(now_s);
  info.fraction = progress.fraction;
  info.eta_s = progress.eta_s;
  return info;
}

control::Progress progress_of(const control::JobInfo& info) {
  control::Progress p;
  p.job = info.job;
  p.state = info.state;
  p.tiles = info.tiles;
  p.tiles_whole = info.tiles_whole;
  p.rounds = info.rounds;
  p.fraction = info.fraction;
  return p;
}

control::Progress RunningJob::progress_at(double now_s) const {
  control::Progress p = progress_of(info());
  if (!render_) return p;
  p.fraction = p.tiles == 0 ? 1 : static_cast<double>(p.tiles_whole) / p.tiles;
  const double traced = p.tiles == 0 ? 1 : p.fraction - 1.0 * resumed_tiles_ / p.tiles;
  if (stage_ >= JobStage::kRendering && traced > 0) {
    p.eta_s = std::max(0.0, (now_s - times_.render_began_s) * (1 - p.fraction) / traced);
  }
  if (p.rounds > 0) p.token = render_->token();
  return p;
}

std::string RunningJob::statistics(double now_s, const CpuMeter& cpu,
                                   const std::string& failed) const {
  const PreparedScene& scene = render_->scene();
  Statistics s;
  s.failed = failed;
  s.version = farm_.version;
  s.scene = info_.scene;
  s.algorithm = scene.algorithm;
  s.nodes = farm_.cube.nodes();
  s.threads = render_->threads();
  s.dimension = farm_.cube.dimension();
  const NodeMesh mesh(farm_.cube, scene.mesh);
  s.grid = {mesh.columns(), mesh.rows()};
  if (scene.mesh == MeshMode::k3d) s.grid.push_back(mesh.slabs());
  s.mesh = scene.mesh;
  s.scatter = scene.grid.scatter;
  s.shadows = scene.shadows;
  s.partition = scene.partition;
  s.flow = scene.flow;
  s.fifo = scene.fifo;
  s.sums = render_->sums();
  s.subdivision = scene.subdivision;
  s.returns = scene.returns;
  s.boundaries = scene.boundaries;
  if (render_->sliding() != nullptr) s.sliding = render_->sliding()->figures();
  s.image = scene.settings.image;
  s.primitives = scene.primitives;
  s.objects = scene.objects;
  s.wall_s = now_s - times_.submitted_s;
  s.frontal_cpu_s = cpu.used_s() - cpu_before_.used_s;
  s.cpu_s = s.frontal_cpu_s;
  s.start_cpu_s = cpu.starting_s() - cpu_before_.starting_s;
  s.load_s = scene.load_s;
  s.partition_s = scene.partition_s;
  s.build_s = times_.render_began_s - times_.build_began_s;
  s.render_s = times_.render_ended_s - times_.render_began_s;
  s.slices = farm_.cube.nodes();
  s.slice_bytes = render_->slices().own_bytes();
  s.epochs = epochs();
  s.losses = losses_;
  s.resumed_tiles = resumed_tiles_;
  s.token_rounds = render_->token().round;
  s.token_hops = render_->token().hops;
  s.per_node = render_->reports().stats();
  for (const control::NodeStats& n : s.per_node) {
    s.cpu_s += n.cpu_s;
    s.start_cpu_s += n.start_cpu_s;
  }
  return statistics_json(s);
}

}  // namespace graycube
