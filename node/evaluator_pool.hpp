// The evaluator threads of a node. They share the brain with the mailroom under one lock, never
// touch a socket, and never wait for one: what they produce is left with the brain, and the
// mailroom is woken.
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "node/node.hpp"
#include "node/wait_clock.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {

class EvaluatorPool {
 public:
  /// `is_guest`: the process was started for another node, whose pool reports what CPU time and
  /// memory the whole process takes, so that nothing is counted twice.
  EvaluatorPool(Node& node, Wakeup& mailroom, bool is_guest);
  /// Ends all threads; work under way is finished first.
  ~EvaluatorPool();

  /// Runs `action()` on the brain with no evaluator inside it, then lets the evaluators look for
  /// work.
  template <typename Action>
  auto with_node(Action&& action) {
    const std::lock_guard lock(mutex_);
    struct AtEnd {
      EvaluatorPool& pool;
      ~AtEnd() { pool.after_change(); }
    } at_end{*this};
    return action();
  }

 private:
  void work(unsigned index);
  void after_change();
  void grow(unsigned threads);
  void measure(control::NodeStats& stats);
  void measure_process(control::NodeStats& stats);

  Node& node_;
  Wakeup& mailroom_;
  bool is_guest_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::thread> threads_;
  unsigned waiting_ = 0;
  bool stopping_ = false;
  WaitClock clock_;
  std::optional<WaitClock::Time> last_primary_;
  double busy_s_ = 0;
  double cpu_reported_s_ = 0;
  /// CPU seconds before the first job; nothing until that job came, 0 once they are reported.
  std::optional<double> start_cpu_s_;
};

}  // namespace graycube
