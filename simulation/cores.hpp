// Processor cores: tasks take them in the order in which they ask, and keep them to their end.
#pragma once

#include <deque>
#include <functional>
#include <utility>

#include "simulation/timeline.hpp"

namespace graycube::simulation {

class Cores {
 public:
  struct Task {
    /// Called when a core is free; returns the seconds that the task takes from then on.
    std::function<double()> begin;
    std::function<void()> end;
  };

  /// `count` 0: as many as are asked for.
  Cores(Timeline& timeline, unsigned count) : timeline_(timeline), count_(count) {}

  void ask(Task task) {
    if (count_ != 0 && busy_ == count_) {
      waiting_.push_back(std::move(task));
    } else {
      start(std::move(task));
    }
  }

 private:
  void start(Task task) {
    ++busy_;
    const double seconds = task.begin();
    if (count_ == 0 && seconds <= 0) return finish(task);
    timeline_.after(seconds, [this, task = std::move(task)] { finish(task); });
  }
  /// The core is free only when what follows from the task has been asked for: that waits behind the others.
  void finish(const Task& task) {
    task.end();
    --busy_;
    if (waiting_.empty()) return;
    Task next = std::move(waiting_.front());
    waiting_.pop_front();
    start(std::move(next));
  }

  Timeline& timeline_;
  unsigned count_;
  unsigned busy_ = 0;
  std::deque<Task> waiting_;
};

}  // namespace graycube::simulation
