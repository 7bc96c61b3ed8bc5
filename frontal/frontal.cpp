#include "frontal/frontal.hpp"

#include <algorithm>
#include <utility>

#include "proto/control.hpp"

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
  // When this process itself was held up, answers wait unread: that time is not the nodes' silence.
  const double held_up_s = now_s - now_s_;
  if (now_s_ > 0 && held_up_s > options_.heartbeat_s) {
    for (NodeRecord& node : nodes_) node.last_heard_s += held_up_s;
  }
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
    if (now_s_ - node.last_heard_s < options_.silence_s) continue;
    kills_.push_back({Rank{rank}, node.incarnation});
    lose(Rank{rank}, "fell silent");
  }
  if (running_ && running_->options.timeout_s > 0 &&
      now_s_ - running_->began_at_s > running_->options.timeout_s) {
    end_job(JobState::kFailed, FailureCode::kTimeout,
            {{"--timeout", "the render did not end in time"}});
  }
  if (running_ && !running_->deadlock.empty() &&
      now_s_ - running_->render_ended_s > kReportPatience_s) {
    end_as_deadlocked();
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

void Frontal::on_message(const PeerId& peer, const MessageView& message) {
  const auto rank = rank_of(peer);
  if (rank) nodes_[rank->value].last_heard_s = now_s_;
  if (looks_like_batch(message.frame)) {
    if (rank) on_contributions(message.frame);
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
  failed_starts_ = 0;
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
  if (node.pid == 0 && ++failed_starts_ >= kMaxFailedStarts) {
    fatal_error_ = name + ": can't be started: " + how;
    return go_down();
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
  } else if (const auto* borrow = std::get_if<control::Borrow>(&message)) {
    lend(rank, *borrow);
  } else if (const auto* wish = std::get_if<control::Share>(&message)) {
    share(rank, *wish);
  } else if (const auto* waits = std::get_if<control::WaitReport>(&message)) {
    watch_for_deadlock(rank, *waits);
  } else if (const auto* ready = std::get_if<control::Ready>(&message)) {
    if (!render.is_meant(*ready)) return;
    render.set_ready(rank);
    if (render.all_ready() && !running_->is_started) start_rendering();
  } else if (const auto* round = std::get_if<control::TokenRound>(&message)) {
    if (!render.is_meant(*round)) return;
    render.set_round(round->round, round->hops);
    running_->info.rounds = round->round;
    report_progress(true);
  } else if (const auto* end = std::get_if<control::Terminated>(&message)) {
    if (!render.is_meant(*end)) return;
    render.set_terminated(*end);
    render.set_round(end->rounds, end->hops);
    finish_when_complete();
  } else if (const auto* report = std::get_if<control::NodeReport>(&message)) {
    if (report->job != render.id()) return;
    render.set_report(*report);
    if (!running_->is_finishing || !render.all_reported()) return;
    running_->deadlock.empty() ? complete() : end_as_deadlocked();
  }
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
  return std::all_of(nodes_.begin(), nodes_.end(), [](const NodeRecord& n) { return n.has_left; });
}

// ---- sending

void Frontal::send(const PeerId& peer, const ControlMessage& message, SharedBytes payload) {
  outgoing_.push_back({peer, Message::of_text(encode(message), std::move(payload))});
}

void Frontal::send_to_nodes(const ControlMessage& message) {
  const Message encoded = Message::of_text(encode(message));
  for (const NodeRecord& n : nodes_) {
    if (!n.peer.empty()) outgoing_.push_back({n.peer, encoded});
  }
}

std::vector<Frontal::Outgoing> Frontal::take_outgoing() { return std::exchange(outgoing_, {}); }
std::vector<Frontal::Spawn> Frontal::take_spawns() { return std::exchange(spawns_, {}); }
std::vector<Frontal::Spawn> Frontal::take_kills() { return std::exchange(kills_, {}); }

}  // namespace graycube
