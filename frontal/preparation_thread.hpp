// Prepares scenes beside the mailroom, which must stay quick to answer.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>

#include "frontal/preparation/preparation.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {

class PreparationThread {
 public:
  explicit PreparationThread(Wakeup& mailroom) : mailroom_(mailroom), thread_([this] { run(); }) {}
  ~PreparationThread() {
    {
      const std::lock_guard lock(mutex_);
      stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  bool is_free() {
    const std::lock_guard lock(mutex_);
    return !work_ && !busy_ && !result_;
  }
  void give(PreparationWork work) {
    const std::lock_guard lock(mutex_);
    work_ = std::move(work);
    changed_.notify_all();
  }
  std::optional<PreparationResult> take() {
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
      const PreparationWork work = std::move(*work_);
      work_.reset();
      busy_ = true;
      lock.unlock();
      PreparationResult result = prepare(work, seconds);
      lock.lock();
      busy_ = false;
      result_ = std::move(result);
      mailroom_.signal();
    }
  }

  Wakeup& mailroom_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<PreparationWork> work_;
  std::optional<PreparationResult> result_;
  bool busy_ = false, stopping_ = false;
  std::thread thread_;
};

}  // namespace graycube
