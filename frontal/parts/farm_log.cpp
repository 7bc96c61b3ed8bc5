#include "frontal/parts/farm_log.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <iterator>
#include <utility>

namespace graycube {
namespace {

using Kind = FarmEvent::Kind;

std::string seconds_text(double seconds) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.1f s", seconds);
  return text.data();
}

std::string count_text(std::uint64_t count, const std::string& thing) {
  return std::to_string(count) + " " + thing + (count == 1 ? "" : "s");
}

std::string cut(const std::string& text, std::size_t longest) {
  if (text.size() <= longest) return text;
  std::size_t end = longest;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0) == 0x80) --end;  // UTF-8
  return text.substr(0, end) + "…";
}

/// Whatever a client calls its scene, the quotes tell where the name ends.
std::string named(const std::string& scene) {
  std::string name = cut(scene, kMaxNameLogged);
  std::ranges::replace(name, '"', '\'');
  return "\"" + name + "\"";
}

std::string shortened(const std::string& reason) { return cut(reason, kMaxReasonLogged); }

std::string job_text(std::uint32_t job) { return "job " + std::to_string(job) + ": "; }

}  // namespace

void FarmLog::set_time(double unix_s) {
  now_s_ = unix_s;
  if (now_s_ - span_began_s_ < kRefusalSpan_s) return;
  tell_untold();
  span_began_s_ = now_s_;
  refusals_ = 0;
}

void FarmLog::tell_untold() {
  if (untold_ == 0) return;
  const std::uint64_t count = std::exchange(untold_, 0);
  note(Kind::kRefusal, 0, count_text(count, "more refusal") + " like the last ones").is_trouble =
      true;
}

FarmEvent& FarmLog::note(Kind kind, std::uint32_t job, std::string text) {
  if (events_.size() >= kMaxUntakenEvents) events_.pop_front();
  FarmEvent event;
  event.kind = kind;
  event.unix_s = now_s_;
  event.job = job;
  event.text = std::move(text);
  events_.push_back(std::move(event));
  return events_.back();
}

std::vector<FarmEvent> FarmLog::take() {
  std::vector<FarmEvent> events(std::make_move_iterator(events_.begin()),
                                std::make_move_iterator(events_.end()));
  events_.clear();
  return events;
}

// ---- the farm and its nodes

void FarmLog::farm_is_up(std::uint32_t nodes, const std::string& endpoint) {
  if (std::exchange(is_up_, true)) return;
  note(Kind::kFarmIsUp, 0, "farm: up with " + count_text(nodes, "node") + " at " + endpoint);
}

void FarmLog::farm_goes_down(const std::string& why) {
  note(Kind::kFarmGoesDown, 0, "farm: goes down" + (why.empty() ? "" : ": " + shortened(why)))
      .is_trouble = !why.empty();
}

void FarmLog::node_is_lost(Rank rank, const std::string& name, const std::string& how,
                           double noticed_s) {
  lost_ranks_.insert(rank.value);
  ++counts_.nodes_lost;
  note(Kind::kNodeIsLost, 0,
       "lost " + name + ": " + shortened(how) + ", noticed after " + seconds_text(noticed_s))
      .is_trouble = true;
}

void FarmLog::job_loses(std::uint32_t job, const Loss& loss, const std::string& name, bool is_gone,
                        std::uint32_t epochs) {
  if (loss.rank && is_gone) lost_ranks_.insert(*loss.rank);
  ++(is_gone ? counts_.nodes_lost : counts_.messages_lost);
  std::string text = job_text(job) + (is_gone ? "lost " : "") + name + ": " + shortened(loss.why);
  if (is_gone) text += ", noticed after " + seconds_text(loss.noticed_s);
  text += "; " + count_text(loss.tiles, "tile") + " again, epoch " + std::to_string(epochs);
  FarmEvent& event = note(Kind::kNodeIsLost, job, std::move(text));
  event.is_trouble = true;
  event.loss = loss;
}

void FarmLog::host_joins(const control::Join& host) {
  note(Kind::kHostJoins, 0,
       "host " + cut(host.host, kMaxNameLogged) + " (process " + std::to_string(host.pid) +
           ") joins: " + count_text(host.cores, "core") + ", room for " +
           count_text(host.slots, "node"));
}

void FarmLog::host_is_lost(const std::string& name, const std::string& how, std::size_t nodes) {
  note(Kind::kHostIsLost, 0,
       "host " + cut(name, kMaxNameLogged) + " " + how + "; it had " + count_text(nodes, "node"))
      .is_trouble = true;
}

void FarmLog::farm_is_fitted(std::uint32_t nodes, std::size_t hosts) {
  note(Kind::kHostJoins, 0,
       "farm: of " + count_text(nodes, "node") + " on " + count_text(hosts, "host") + " now");
}

void FarmLog::node_has_host(const std::string& name, const std::string& what) {
  note(Kind::kNodeHasHost, 0, name + " " + shortened(what)).is_trouble = true;
}

void FarmLog::node_is_here(Rank rank, std::uint64_t pid) {
  if (lost_ranks_.erase(rank.value) == 0) return;
  note(Kind::kNodeIsBack, 0,
       "node " + std::to_string(rank.value) + ": process " + std::to_string(pid) +
           " has taken its place");
}

// ---- jobs

void FarmLog::job_is_accepted(const control::JobInfo& job, bool is_recovered) {
  ++counts_.jobs_accepted;
  note(Kind::kJobAccepted, job.job,
       job_text(job.job) + (is_recovered ? "taken up again, " : "submitted, ") + named(job.scene));
}

void FarmLog::job_begins(const control::JobInfo& job, std::uint32_t frontals) {
  note(Kind::kJobBegins, job.job,
       job_text(job.job) + "begins" +
           (frontals == 0
                ? ""
                : " again, after " + count_text(frontals, "frontal") + " that had begun it ended"));
}

void FarmLog::job_stands(std::uint32_t job, const std::string& waits_for) {
  note(Kind::kJobStands, job, job_text(job) + "doesn't get on: waits for " + waits_for).is_trouble =
      true;
}

void FarmLog::job_ends(const control::JobInfo& job) {
  ++(job.state == JobState::kDone     ? counts_.jobs_done
     : job.state == JobState::kFailed ? counts_.jobs_failed
                                      : counts_.jobs_cancelled);
  std::string text = job_text(job.job) + std::string(to_string(job.state));
  if (job.started_s && job.finished_s)
    text += " after " + seconds_text(*job.finished_s - *job.started_s);
  if (job.state != JobState::kDone && !job.message.empty()) text += ": " + shortened(job.message);
  note(Kind::kJobEnds, job.job, std::move(text)).is_trouble = job.state == JobState::kFailed;
}

// ---- the frontal's process

void FarmLog::process_tells(std::string text, bool is_trouble) {
  note(Kind::kProcessTells, 0, std::move(text)).is_trouble = is_trouble;
}

// ---- refusals

void FarmLog::refuse(std::string text) {
  if (++refusals_ > kMaxRefusalsTold) {
    ++untold_;
    return;
  }
  note(Kind::kRefusal, 0, std::move(text)).is_trouble = true;
}

void FarmLog::submission_is_refused(const std::string& scene, const std::string& why) {
  ++counts_.refused_submissions;
  refuse("refused: a submission of " + named(scene) + ": " + shortened(why));
}

void FarmLog::hello_is_refused(std::uint32_t rank, const std::string& why) {
  ++counts_.refused_nodes;
  refuse("refused: a hello for node " + std::to_string(rank) + ": " + why);
}

void FarmLog::stranger_is_refused(const TurnedAway& peer) {
  ++counts_.refused_clients;
  refuse("refused: a connection" + (peer.address.empty() ? "" : " from " + peer.address) +
         " without the farm's key: " + sentence_of(peer.reason));
}

void FarmLog::crowd_is_refused(std::uint64_t connections, int most) {
  counts_.refused_connections += connections;
  refuse("refused: " + count_text(connections, "connection") + " beyond the " +
         std::to_string(most) + " that clients may have");
}

// ---- figures

void FarmLog::nodes_reported(std::span<const control::NodeStats> nodes, std::uint64_t slice_bytes) {
  control::FarmCounts& c = counts_;
  c.last_queue_peak = c.last_outbox_peak = c.last_memory_bytes = 0;
  c.slice_batches += nodes.size();
  c.slice_bytes += slice_bytes;
  for (const control::NodeStats& n : nodes) {
    c.primary += n.primary;
    c.shadow += n.shadow;
    c.reflection += n.reflection;
    c.refraction += n.refraction;
    c.forwarded_primary += n.forwarded_primary;
    c.forwarded_shadow += n.forwarded_shadow;
    c.forwarded_secondary += n.forwarded_secondary;
    c.ray_batches += n.ray_batches;
    c.ray_bytes += n.ray_bytes;
    c.contribution_batches += n.contribution_batches;
    c.contribution_bytes += n.contribution_bytes;
    c.sum_batches += n.sum_batches;
    c.sum_bytes += n.sum_bytes;
    c.answer_batches += n.answer_batches;
    c.answer_bytes += n.answer_bytes;
    c.slice_batches += n.slice_batches;
    c.slice_bytes += n.slice_bytes;
    c.malformed_drops += n.malformed_drops;
    c.busy_s += n.busy_s;
    c.blocked_s += n.blocked_s;
    c.window_s += n.window_s;
    c.idle_s += n.idle_s;
    c.fifo_wait_s += n.fifo_wait_s;
    c.nodes_cpu_s += n.cpu_s;
    c.last_queue_peak = std::max(c.last_queue_peak, n.queue_peak);
    c.last_outbox_peak = std::max(c.last_outbox_peak, n.outbox_peak);
    c.last_memory_bytes = std::max(c.last_memory_bytes, n.memory_bytes);
  }
}

}  // namespace graycube
