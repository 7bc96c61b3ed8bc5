// The watch of a simulated farm over its brains: their time, and promises that they break.
#include <algorithm>
#include <utility>

#include "proto/batch.hpp"
#include "simulation/farm.hpp"

namespace graycube::simulation {
namespace {

WaitClock::Time moment(double seconds) {
  return WaitClock::Time(std::chrono::duration_cast<WaitClock::Time::duration>(
      std::chrono::duration<double>(seconds)));
}

std::uint32_t bit_between(const Hypercube& cube, Rank a, Rank b) {
  return *cube.link_between(a, b);
}

}  // namespace

/// Only changes are told to the clock: after a deadlock there are none, so that the time afterwards
/// counts for nobody.
void Farm::watch_time(Process& p) {
  const WaitReason reason = p.node->wait_reason();
  const bool is_rendering = p.node->is_rendering();
  const unsigned waiting = p.node->threads() - std::min(p.active, p.node->threads());
  if (reason == p.reason && is_rendering == p.is_rendering && waiting == p.waiting) return;
  if (!has_failed_) last_change_s_ = timeline_.now_s();
  if (is_rendering && !p.is_rendering && render_began_s_ < 0) render_began_s_ = last_change_s_;
  p.reason = reason;
  p.is_rendering = is_rendering;
  p.waiting = waiting;
  p.clock.update(moment(last_change_s_), reason, waiting, is_rendering);
}

void Farm::fill_in(Process& p, control::NodeStats& stats) {
  const double end_s = has_failed_ ? last_change_s_ : timeline_.now_s();
  p.clock.update(moment(end_s), p.reason, p.waiting, false);
  p.is_rendering = false;
  stats.cpu_s = std::exchange(p.cpu_s, 0);
  stats.fifo_cpu_s = std::exchange(p.fifo_cpu_s, 0);
  stats.busy_s = std::exchange(p.busy_s, 0);
  stats.endgame_s = std::max(0.0, end_s - p.last_primary_s);
  stats.idle_s = p.clock.seconds(WaitReason::kIdle);
  stats.blocked_s = p.clock.seconds(WaitReason::kBlocked);
  stats.window_s = p.clock.seconds(WaitReason::kWindow);
  stats.fifo_wait_s = p.clock.seconds(WaitReason::kFetching);
  p.clock.reset();
}

void Farm::watch_to_node(const Message& message) {
  if (looks_like_batch(message.frame)) return;
  const auto decoded = decode(message.text());
  const auto* m = std::get_if<ControlMessage>(&decoded);
  if (m == nullptr) return;
  if (std::holds_alternative<control::Finish>(*m)) {
    has_failed_ = !is_over_ && load_.algorithm == Algorithm::kMacro;
  }
  if (const auto* prepare = std::get_if<control::Prepare>(m)) watch_epoch(prepare->epoch);
  if (const auto* load = std::get_if<control::Load>(m)) {
    const bool is_new = load->job != load_.job;
    load_ = *load;
    if (is_new) epoch_ = load->epoch + 1;  // whatever it was, another one begins
    watch_epoch(load->epoch);
  }
}

/// An epoch begins: nothing of those before counts.
void Farm::watch_epoch(std::uint32_t epoch) {
  if (epoch == epoch_) return;
  epoch_ = epoch;
  is_over_ = false;
  rays_under_way_ = 0;
  sums_under_way_ = 0;
  for (Process& p : processes_) {
    p.working = 0;
    std::ranges::fill(p.unreturned, 0);
    std::ranges::fill(p.places_out, ClassPlaces{});
  }
}

void Farm::watch_to_frontal(const Message& message) {
  if (looks_like_batch(message.frame)) return;
  const auto decoded = decode(message.text());
  const auto* m = std::get_if<ControlMessage>(&decoded);
  if (m == nullptr) return;
  if (std::holds_alternative<control::Terminated>(*m)) {
    is_over_ = true;
    check_quiet();
  }
  const auto* report = std::get_if<control::NodeReport>(m);
  if (report == nullptr) return;
  ++reports_;
  outcome_.reports.resize(cube_.nodes());
  outcome_.reports[report->stats.rank] = report->stats;
}

void Farm::watch_batch(Rank from, Rank to, const Bytes& batch, bool is_sent) {
  const auto header = peek_header(batch);
  const auto* h = std::get_if<BatchHeader>(&header);
  if (h == nullptr || h->stamp.job != load_.job || h->stamp.epoch != epoch_) return;
  // What was meant for the process before is of no use to one that has taken its place.
  if (!is_sent && !(processes_[to.value].node && processes_[to.value].node->has_job())) return;
  if (h->type == BatchType::kRays || h->type == BatchType::kClassRays)
    rays_under_way_ += is_sent ? 1 : -1;
  if (h->type == BatchType::kContributions || h->type == BatchType::kAnswers)
    sums_under_way_ += is_sent ? 1 : -1;
  if (h->type == BatchType::kClassRays || h->type == BatchType::kClassCredit) {
    return watch_classes(from, to, batch, h->type, is_sent);
  }
  if (h->type == BatchType::kRays) {
    if (!is_sent) return;
    if (is_over_) outcome_.violations.push_back("rays were sent after the token's end");
    std::uint64_t& unreturned = processes_[from.value].unreturned[bit_between(cube_, from, to)];
    unreturned += h->count * kRayBytes;
    if (unreturned > load_.link_credit_bytes) {
      outcome_.violations.push_back("more rays were sent than the link's credit allows");
    }
  } else if (h->type == BatchType::kLinkCredit && !is_sent) {
    std::uint64_t bytes = 0;
    BatchLimits limits;
    limits.nodes = cube_.nodes();
    if (std::holds_alternative<BatchError>(decode_link_credit(batch, limits, bytes))) return;
    std::uint64_t& unreturned = processes_[to.value].unreturned[bit_between(cube_, from, to)];
    if (bytes > unreturned) outcome_.violations.push_back("a link got more credit than it gave");
    unreturned -= std::min(unreturned, bytes);
  }
}

/// Checks that no more rays of a class are on their way on a link, or wait behind it, than the link
/// has places for them.
void Farm::watch_classes(Rank from, Rank to, const Bytes& batch, BatchType type, bool is_sent) {
  const BatchLimits limits{.pixel_count = kMaxPixels,
                           .max_depth = kMaxDepth,
                           .nodes = cube_.nodes(),
                           .are_rays_numbered = load_.returns == ReturnsMode::kSender,
                           .may_slide = load_.boundaries == BoundariesMode::kSliding};
  if (type == BatchType::kClassRays && is_sent) {
    if (is_over_) outcome_.violations.push_back("class rays were sent after the token's end");
    ClassPlaces& out = processes_[from.value].places_out[bit_between(cube_, from, to)];
    std::vector<RayTask> rays;
    if (std::holds_alternative<BatchError>(decode_rays(batch, limits, rays, type))) {
      outcome_.violations.push_back("a broken batch of class rays was sent");
    }
    outcome_.class_rays += rays.size();
    for (const RayTask& ray : rays) {
      if (!out.take(ray.hops, load_.class_places))
        outcome_.violations.push_back("a class has more rays on a link than places");
    }
  } else if (type == BatchType::kClassCredit && !is_sent) {
    ClassPlaces& out = processes_[to.value].places_out[bit_between(cube_, from, to)];
    std::vector<std::uint16_t> classes;
    if (std::holds_alternative<BatchError>(decode_class_credit(batch, limits, classes))) return;
    for (const std::uint16_t c : classes) {
      if (!out.give_back(c)) outcome_.violations.push_back("a class got more credit than it gave");
    }
  }
}

/// Collects reports of what they did from the nodes of a failed job that can still answer.
void Farm::collect_reports() {
  constexpr double kPatience = 100;
  const double until_s = timeline_.now_s() + kPatience * options_.heartbeat_s;
  while (reports_ < cube_.nodes() && timeline_.now_s() < until_s && timeline_.run_one()) {
  }
}

/// Called when the token has found the end: nothing may be left anywhere.
void Farm::check_quiet() {
  if (rays_under_way_ != 0) outcome_.violations.push_back("the token ended with rays under way");
  if (sums_under_way_ != 0)
    outcome_.violations.push_back("the token ended with light under way between nodes");
  for (const Process& p : processes_) {
    if (p.working != 0) outcome_.violations.push_back("the token ended with an evaluator at work");
    if (p.node && p.node->has_unfinished()) {
      outcome_.violations.push_back("the token ended with a node that has work");
    }
  }
}

}  // namespace graycube::simulation
