// Simulated time: events in the order of their moments; those of one moment in the order in which
// they were planned.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <queue>
#include <utility>

namespace graycube::simulation {

class Timeline {
 public:
  using Event = std::function<void()>;

  double now_s() const { return now_s_; }
  bool is_empty() const { return events_.empty(); }
  void at(double at_s, Event event) {
    events_.push({std::max(at_s, now_s_), order_++, std::make_shared<Event>(std::move(event))});
  }
  void after(double seconds, Event event) { at(now_s_ + seconds, std::move(event)); }
  /// Runs the next event; false when there is none.
  bool run_one() {
    if (events_.empty()) return false;
    const Planned next = events_.top();
    events_.pop();
    now_s_ = next.at_s;
    (*next.event)();
    return true;
  }

 private:
  struct Planned {
    double at_s;
    std::uint64_t order;
    std::shared_ptr<Event> event;
    bool operator<(const Planned& o) const {
      return at_s != o.at_s ? at_s > o.at_s : order > o.order;
    }
  };

  std::priority_queue<Planned> events_;
  double now_s_ = 0;
  std::uint64_t order_ = 0;
};

}  // namespace graycube::simulation
