// Prepares scenes, and cuts them anew, beside the mailroom, which must stay quick to answer. Work
// for a job that has ended meanwhile is stopped, so that the next one needn't wait for it.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <variant>

#include "frontal/preparation/preparation.hpp"
#include "frontal/preparation/recut.hpp"
#include "overloaded.hpp"
#include "stop_point.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {

class PreparationThread {
 public:
  using Work = std::variant<PreparationWork, RecutWork>;
  using Result = std::variant<PreparationResult, RecutResult>;

  explicit PreparationThread(Wakeup& mailroom) : mailroom_(mailroom), thread_([this] { run(); }) {}
  ~PreparationThread() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
      stops_work_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  bool is_free() {
    const std::lock_guard lock(mutex_);
    return !work_ && !busy_ && !result_;
  }
  void give(Work work) {
    const std::lock_guard lock(mutex_);
    job_ = std::visit([](const auto& w) { return w.job; }, work);
    stops_work_ = stopping_;
    work_ = std::move(work);
    changed_.notify_all();
  }
  /// Ends the work that is under way unless it is for that job, if there is one; it has no result.
  void work_only_for(std::optional<std::uint32_t> job) {
    const std::lock_guard lock(mutex_);
    if ((work_ || busy_) && job != job_) stops_work_ = true;
  }
  std::optional<Result> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(result_, std::nullopt);
  }

 private:
  static double seconds() {
    const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(since_start).count();
  }
  void run() {
    std::unique_lock lock(mutex_);
    for (;;) {
      changed_.wait(lock, [this] { return stopping_ || work_; });
      if (stopping_) return;
      const Work work = std::move(*work_);
      work_.reset();
      busy_ = true;
      lock.unlock();
      std::optional<Result> result = result_of(work);
      lock.lock();
      busy_ = false;
      result_ = std::move(result);
      mailroom_.signal();
    }
  }
  /// Nothing when it was stopped.
  std::optional<Result> result_of(const Work& work) {
    const Stoppable stoppable(stops_work_);
    try {
      return std::visit(
          Overloaded{[](const PreparationWork& w) -> Result { return prepare(w, seconds); },
                     [](const RecutWork& w) -> Result { return recut(w, seconds); }},
          work);
    } catch (const WorkStopped&) {
      return std::nullopt;
    }
  }

  Wakeup& mailroom_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Work> work_;
  std::optional<Result> result_;
  /// The job that work is for.
  std::uint32_t job_ = 0;
  bool busy_ = false, stopping_ = false;
  std::atomic<bool> stops_work_{false};
  std::thread thread_;
};

}  // namespace graycube
