#include "frontal/frontal.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "geometry/check.hpp"
#include "proto/control.hpp"
#include "proto/statistics.hpp"

namespace graycube {

Frontal::Frontal(FrontalOptions options, JobStore& store)
    : options_(std::move(options)), store_(store), nodes_(options_.cube.nodes()) {
  for (EndedJob& job : store_.recover()) {
    next_job_ = std::max(next_job_, job.info.job + 1);
    ended_.push_back(std::move(job));
    if (ended_.size() > kMaxEndedJobs) ended_.pop_front();
  }
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) spawn(Rank{rank});
}

// ---- time

void Frontal::on_time(double now_s, double unix_s) {
  now_s_ = now_s;
  unix_s_ = unix_s;
  if (going_down_) return;
  if (now_s_ - last_ping_s_ >= options_.heartbeat_s) {
    last_ping_s_ = now_s_;
    send_to_nodes(control::Ping{++pings_});
  }
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) {
    NodeRecord& node = nodes_[rank];
    if (node.last_heard_s == 0) node.last_heard_s = now_s_;
    if (node.is_lost || now_s_ - node.last_heard_s < options_.silence_s) continue;
    kills_.push_back({Rank{rank}, node.incarnation});
    lose(Rank{rank}, "fell silent");
  }
  if (running_ && running_->options.timeout_s > 0 &&
      now_s_ - running_->began_at_s > running_->options.timeout_s) {
    end_job(JobState::kFailed, FailureCode::kTimeout,
            {{"--timeout", "the render did not end in time"}});
  }
  report_progress(false);
}

// ---- nodes

void Frontal::spawn(Rank rank) {
  NodeRecord& node = nodes_[rank.value];
  node = {};
  node.incarnation = next_incarnation_++;
  node.last_heard_s = now_s_;
  spawns_.push_back({rank, node.incarnation});
}

std::optional<Rank> Frontal::rank_of(const PeerId& peer) const {
  const auto found = node_peers_.find(peer);
  if (found == node_peers_.end()) return std::nullopt;
  return found->second;
}

void Frontal::on_message(const PeerId& peer, const Message& message) {
  const auto rank = rank_of(peer);
  if (rank) nodes_[rank->value].last_heard_s = now_s_;
  if (looks_like_batch(message.frame)) {
    if (rank) on_contributions(*rank, message.frame);
    return;
  }
  const auto decoded = decode(message.text());
  if (const auto* error = std::get_if<ControlError>(&decoded)) {
    return refuse(peer, 0, FailureCode::kBadRequest, error->field, error->why);
  }
  const auto& m = std::get<ControlMessage>(decoded);
  if (const auto* hello = std::get_if<control::Hello>(&m)) return on_hello(peer, *hello);
  if (rank) return on_node(*rank, m);
  on_client(peer, m, message);
}

void Frontal::on_hello(const PeerId& peer, const control::Hello& m) {
  if (m.rank >= nodes_.size()) {
    return refuse(peer, 0, FailureCode::kBadRequest, "rank", "no such node in this farm");
  }
  NodeRecord& node = nodes_[m.rank];
  if (node.incarnation != m.incarnation) {
    return refuse(peer, 0, FailureCode::kBadRequest, "incarnation", "another process is this node");
  }
  node.peer = peer;
  node.pid = m.pid;
  node.endpoint = m.endpoint;
  node.threads = m.threads;
  node.last_heard_s = now_s_;
  node_peers_[peer] = Rank{m.rank};
  if (all_nodes_here()) welcome_all();
  load_when_possible();
}

bool Frontal::all_nodes_here() const {
  return std::all_of(nodes_.begin(), nodes_.end(),
                     [](const NodeRecord& n) { return !n.peer.empty(); });
}

void Frontal::welcome_all() {
  control::Welcome m;
  m.nodes = options_.cube.nodes();
  m.version = options_.version;
  m.heartbeat_ms = static_cast<std::uint32_t>(options_.heartbeat_s * 1000);
  for (const NodeRecord& n : nodes_) m.endpoints.push_back(n.endpoint);
  send_to_nodes(m);
}

void Frontal::on_node_exit(Rank rank, std::uint32_t incarnation, const std::string& how) {
  NodeRecord& node = nodes_[rank.value];
  if (node.incarnation != incarnation) return;
  node.has_left = true;
  if (!going_down_) lose(rank, how);
}

/// The running job fails with the node's name; a new process takes its place for the next one.
void Frontal::lose(Rank rank, const std::string& how) {
  NodeRecord& node = nodes_[rank.value];
  const std::string name =
      "node " + std::to_string(rank.value) +
      (node.pid != 0 ? " (process " + std::to_string(node.pid) + ")" : std::string{});
  node_peers_.erase(node.peer);
  if (running_ && (running_->is_loaded || node.pid == 0)) {
    end_job(JobState::kFailed, FailureCode::kFailed, {{name, how}});
  }
  spawn(rank);
}

void Frontal::on_node(Rank rank, const ControlMessage& message) {
  if (std::holds_alternative<control::Goodbye>(message)) {
    nodes_[rank.value].has_left = true;
    return;
  }
  if (!running_ || !running_->render) return;
  RenderJob& render = *running_->render;
  if (const auto* m = std::get_if<control::NodeError>(&message)) {
    if (m->job == render.id()) {
      end_job(JobState::kFailed, FailureCode::kFailed,
              {{"node " + std::to_string(rank.value), m->message}});
    }
  } else if (const auto* ready = std::get_if<control::Ready>(&message)) {
    if (ready->job != render.id() || ready->epoch != render.epoch()) return;
    render.set_ready(rank, *ready);
    if (render.all_ready() && !running_->is_started) start_rendering();
  } else if (const auto* round = std::get_if<control::TokenRound>(&message)) {
    if (round->job != render.id() || round->epoch != render.epoch()) return;
    render.set_round(round->round, round->hops);
    running_->info.rounds = round->round;
    report_progress(true);
  } else if (const auto* end = std::get_if<control::Terminated>(&message)) {
    if (end->job != render.id() || end->epoch != render.epoch()) return;
    render.set_terminated(*end);
    render.set_round(end->rounds, end->hops);
    finish_when_complete();
  } else if (const auto* report = std::get_if<control::NodeReport>(&message)) {
    if (report->job != render.id()) return;
    render.set_report(*report);
    if (running_->is_finishing && render.all_reported()) complete();
  }
}

// ---- jobs

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
  Running& job = running_.emplace();
  job.info = next.info;
  job.options = next.work.options;
  job.submitted_at_s = next.submitted_at_s;
  job.began_at_s = now_s_;
  job.is_preparing = true;
  job.cpu_at_start_s = job.info.job == 1 ? 0 : cpu_seconds();
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
  const std::uint32_t threads =
      running_->options.threads != 0 ? running_->options.threads : options_.threads;
  running_->render.emplace(result.job, std::move(*result.scene), options_.cube.nodes(), threads);
  running_->info.algorithm = running_->render->scene().algorithm;
  running_->info.tiles = static_cast<std::uint32_t>(running_->render->tiles());
  load_when_possible();
}

void Frontal::load_when_possible() {
  if (!running_ || !running_->render || running_->is_loaded || !all_nodes_here()) return;
  running_->is_loaded = true;
  running_->build_began_s = now_s_;
  running_->info.state = JobState::kBuilding;
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) {
    send(nodes_[rank].peer, running_->render->load_for(Rank{rank}),
         running_->render->take_slice(Rank{rank}));
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

void Frontal::on_contributions(Rank, const Bytes& batch) {
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
  running_->info.tiles_whole = static_cast<std::uint32_t>(running_->render->tiles_whole());
  finish_when_complete();
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
  const Picture picture = running_->render->film().develop();
  running_->info.state = JobState::kDone;
  running_->info.finished_s = unix_s_;
  running_->info.fraction = 1;
  const EndedJob job{running_->info, statistics()};
  running_.reset();
  keep(job, picture);
}

/// Ends the running job without a picture; the nodes drop it.
void Frontal::end_job(JobState state, FailureCode code, std::vector<control::ErrorItem> errors) {
  if (running_->is_loaded) send_to_nodes(control::Finish{running_->info.job});
  EndedJob job{running_->info, "{}"};
  if (running_->is_preparing && !queue_.empty() && queue_.front().info.job == job.info.job) {
    queue_.pop_front();
  }
  running_.reset();
  job.info.state = state;
  job.info.finished_s = unix_s_;
  if (!errors.empty()) {
    job.info.message = (errors.front().where.empty() ? "" : errors.front().where + ": ") +
                       errors.front().why;
  }
  for (const PeerId& peer : watchers_[job.info.job]) {
    send(peer, control::Failed{job.info.job, code, errors});
  }
  watchers_.erase(job.info.job);
  keep(std::move(job), {});
}

void Frontal::keep(EndedJob job, const Picture& picture) {
  try {
    store_.keep(job, picture);
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

std::string Frontal::statistics() const {
  const RenderJob& render = *running_->render;
  Statistics s;
  s.version = options_.version;
  s.scene = running_->info.scene;
  s.algorithm = render.scene().algorithm;
  s.nodes = options_.cube.nodes();
  s.threads = render.threads();
  s.dimension = options_.cube.dimension();
  s.grid = {options_.cube.columns(), options_.cube.rows()};
  s.image = render.scene().settings.image;
  s.primitives = render.scene().primitives;
  s.objects = render.scene().objects;
  s.wall_s = now_s_ - running_->submitted_at_s;
  s.cpu_s = cpu_seconds() - running_->cpu_at_start_s;
  s.load_s = render.scene().load_s;
  s.partition_s = render.scene().partition_s;
  s.build_s = running_->render_began_s - running_->build_began_s;
  s.render_s = running_->render_ended_s - running_->render_began_s;
  s.token_rounds = render.rounds();
  s.token_hops = render.hops();
  s.per_node = render.reports();
  for (const control::NodeStats& n : s.per_node) s.cpu_s += n.cpu_s;
  return statistics_json(s);
}

// ---- going down

void Frontal::go_down() {
  if (going_down_) return;
  if (running_) end_job(JobState::kCancelled, FailureCode::kCancelled, {{"", "the farm stops"}});
  while (!queue_.empty()) {
    end_queued(0, JobState::kCancelled, FailureCode::kCancelled, "the farm stops");
  }
  going_down_ = true;
  send_to_nodes(control::Shutdown{});
}

bool Frontal::all_nodes_left() const {
  return std::all_of(nodes_.begin(), nodes_.end(),
                     [](const NodeRecord& n) { return n.has_left; });
}

// ---- sending

void Frontal::send(const PeerId& peer, const ControlMessage& message, Bytes payload) {
  outgoing_.push_back({peer, Message::of_text(encode(message), std::move(payload))});
}

void Frontal::send_to_nodes(const ControlMessage& message) {
  for (const NodeRecord& n : nodes_) {
    if (!n.peer.empty()) send(n.peer, message);
  }
}

std::vector<Frontal::Outgoing> Frontal::take_outgoing() { return std::exchange(outgoing_, {}); }
std::vector<Frontal::Spawn> Frontal::take_spawns() { return std::exchange(spawns_, {}); }
std::vector<Frontal::Spawn> Frontal::take_kills() { return std::exchange(kills_, {}); }

}  // namespace graycube
