// Decides when the frontal pings its nodes, and notices when it was itself held up.
#pragma once

#include <cstdint>
#include <optional>

#include "proto/messages.hpp"

namespace graycube {

class Heartbeat {
 public:
  explicit Heartbeat(double interval_s) : interval_s_(interval_s) {}

  /// Seconds since the last call if they are more than an interval, else 0. Answers lay unread in
  /// that time, so it must not count as the nodes' silence.
  double held_up_s(double now_s) {
    const double passed_s = last_asked_s_ > 0 ? now_s - last_asked_s_ : 0;
    last_asked_s_ = now_s;
    return passed_s > interval_s_ ? passed_s : 0;
  }

  /// The next ping, once it is time for it.
  std::optional<control::Ping> take_ping(double now_s) {
    if (now_s - last_ping_s_ < interval_s_) return std::nullopt;
    last_ping_s_ = now_s;
    return control::Ping{++pings_};
  }
  /// The sequence of the newest ping; 0 before the first.
  std::uint64_t last_ping() const { return pings_; }

  std::uint32_t interval_ms() const { return static_cast<std::uint32_t>(interval_s_ * 1000); }

 private:
  double interval_s_;
  double last_asked_s_ = 0, last_ping_s_ = 0;
  std::uint64_t pings_ = 0;
};

}  // namespace graycube
