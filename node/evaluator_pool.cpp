#include "node/evaluator_pool.hpp"

#include <sys/resource.h>

#include <utility>

#include "memory/kept_heap.hpp"
#include "process/clocks.hpp"

namespace graycube {
namespace {

/// About what rays, light and batches under way take of an evaluator's heap, beside what it keeps.
constexpr std::size_t kHeapOfRendering = std::size_t{1} << 20;

}  // namespace

EvaluatorPool::EvaluatorPool(Node& node, Wakeup& mailroom, bool is_guest)
    : node_(node), mailroom_(mailroom), is_guest_(is_guest) {
  node_.measure = [this](control::NodeStats& stats) { measure(stats); };
}

EvaluatorPool::~EvaluatorPool() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  for (std::thread& t : threads_) t.join();
}

void EvaluatorPool::grow(unsigned threads) {
  while (threads_.size() < threads) {
    const auto index = static_cast<unsigned>(threads_.size());
    threads_.emplace_back([this, index] { work(index); });
  }
}

/// Called with the lock held, after anything may have changed in the brain.
void EvaluatorPool::after_change() {
  grow(node_.threads());
  if (!start_cpu_s_ && node_.has_job()) start_cpu_s_ = process_cpu_seconds();
  clock_.update(WaitClock::Time::clock::now(), node_.wait_reason(), waiting_, node_.is_rendering());
  if (node_.has_outgoing() || node_.is_shut_down()) mailroom_.signal();
  if (waiting_ > 0 && node_.may_have_work()) changed_.notify_all();
}

void EvaluatorPool::work(unsigned index) {
  Workbench bench;
  std::unique_lock lock(mutex_);
  double counted_s = thread_cpu_seconds();
  const auto since_last_count = [&] {
    const double now_s = thread_cpu_seconds();
    return now_s - std::exchange(counted_s, now_s);
  };
  while (!stopping_) {
    std::optional<Work> piece;
    if (index < node_.threads()) piece = node_.take_work();
    if (!piece) ++waiting_;
    // This tells the brain's change by the result of the last piece, too.
    after_change();
    if (!piece) {
      busy_s_ += since_last_count();
      if (!node_.has_job()) bench.clear();
      changed_.wait(lock);
      --waiting_;
      continue;
    }
    const bool is_primary = std::holds_alternative<TileWork>(piece->what);
    const bool is_build = !is_primary && !std::holds_alternative<RayWork>(piece->what);
    WaitClock::Time began;
    if (is_build) {
      busy_s_ += since_last_count();
      began = WaitClock::Time::clock::now();
    }
    lock.unlock();
    WorkResult result = bench.run(std::move(*piece));
    // Rendering is counted when the evaluator waits: looking at the clock takes a system call.
    if (is_build) {
      result.build_s = std::chrono::duration<double>(WaitClock::Time::clock::now() - began).count();
      touch_heap_ahead(kHeapOfRendering);
      since_last_count();
    }
    lock.lock();
    if (is_primary) last_primary_ = WaitClock::Time::clock::now();
    node_.give_result(std::move(result));
  }
}

/// Fills in the times since the last report, so that each job of a daemon has its own.
void EvaluatorPool::measure(control::NodeStats& stats) {
  clock_.update(WaitClock::Time::clock::now(), node_.wait_reason(), waiting_, false);
  if (!is_guest_) measure_process(stats);
  stats.busy_s = std::exchange(busy_s_, 0);
  if (last_primary_) {
    const auto since = WaitClock::Time::clock::now() - *last_primary_;
    stats.endgame_s = std::chrono::duration<double>(since).count();
    last_primary_.reset();
  }
  stats.idle_s = clock_.seconds(WaitReason::kIdle);
  stats.blocked_s = clock_.seconds(WaitReason::kBlocked);
  stats.window_s = clock_.seconds(WaitReason::kWindow);
  stats.fifo_wait_s = clock_.seconds(WaitReason::kFetching);
  clock_.reset();
}

/// What the process has used, with all nodes that it hosts.
void EvaluatorPool::measure_process(control::NodeStats& stats) {
  const double cpu_s = process_cpu_seconds();
  stats.cpu_s = cpu_s - std::exchange(cpu_reported_s_, cpu_s);
  stats.start_cpu_s = start_cpu_s_.value_or(0);
  start_cpu_s_ = 0;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  stats.peak_rss_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace graycube
