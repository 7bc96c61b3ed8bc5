// Processor cores and the tasks that run on them, as in an operating system, except that a task is
// never interrupted.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>

#include "simulation/timeline.hpp"

namespace graycube::simulation {

/// Seconds that a process may use a core before others that wait get their turn; from then on, the
/// process that has waited longest is next.
inline constexpr double kTimeSlice_s = 3e-3;

class Cores {
 public:
  struct Task {
    /// The process that the task belongs to.
    std::uint32_t process = 0;
    /// Called when a core is free; returns the seconds that the task takes from then on.
    std::function<double()> begin;
    std::function<void()> end;
    /// The task is short, of a thread that mostly sleeps: such tasks go first.
    bool is_short = false;
  };

  /// `count` 0: as many cores as tasks ask for.
  Cores(Timeline& timeline, unsigned count) : timeline_(timeline), count_(count) {}

  void ask(Task task) {
    if (count_ != 0 && busy_ == count_) {
      waiting_.push_back(std::move(task));
    } else {
      start(std::move(task), 0);
    }
  }

 private:
  /// `used_s`: seconds that the core has worked for the process before this task.
  void start(Task task, double used_s) {
    ++busy_;
    const double seconds = task.begin();
    if (count_ == 0 && seconds <= 0) return finish(task, 0);
    used_s += seconds;
    timeline_.after(seconds, [this, used_s, task = std::move(task)] { finish(task, used_s); });
  }
  /// The core becomes free only after the tasks that follow from this one have been asked for: they
  /// queue behind the others.
  void finish(const Task& task, double used_s) {
    task.end();
    --busy_;
    if (waiting_.empty()) return;
    auto next = std::ranges::find(waiting_, true, &Task::is_short);
    if (next == waiting_.end()) next = waiting_.begin();
    if (!next->is_short && used_s < kTimeSlice_s) {
      const auto own = std::ranges::find(waiting_, task.process, &Task::process);
      if (own != waiting_.end()) next = own;
    }
    Task taken = std::move(*next);
    waiting_.erase(next);
    const bool goes_on = taken.process == task.process && used_s < kTimeSlice_s;
    start(std::move(taken), goes_on ? used_s : 0);
  }

  Timeline& timeline_;
  unsigned count_;
  unsigned busy_ = 0;
  std::deque<Task> waiting_;
};

/// A thread that mostly sleeps, such as a mailroom: its tasks get a core one after the other, and
/// before long ones.
class Thread {
 public:
  explicit Thread(Cores& cores) : cores_(cores) {}

  void ask(Cores::Task task) {
    waiting_.push_back(std::move(task));
    if (!is_busy_) start();
  }

 private:
  void start() {
    is_busy_ = true;
    Cores::Task task = std::move(waiting_.front());
    waiting_.pop_front();
    cores_.ask({task.process, std::move(task.begin),
                [this, end = std::move(task.end)] {
                  end();
                  is_busy_ = false;
                  if (!waiting_.empty()) start();
                },
                true});
  }

  Cores& cores_;
  bool is_busy_ = false;
  std::deque<Cores::Task> waiting_;
};

}  // namespace graycube::simulation
