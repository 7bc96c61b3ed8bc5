// A machine that has joined a farm: a state machine without sockets, processes or clocks. What the
// frontal says, how processes end and the time go in; messages, and processes to start or to end,
// come out.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "host/node_processes.hpp"
#include "proto/messages.hpp"

namespace graycube {

/// Seconds for which a host looks for the frontal: before it has ever joined, and once it has lost
/// it, as the frontal may be started again.
inline constexpr double kFirstJoin_s = 60, kRejoin_s = 10;
/// Nodes that don't end within so many seconds after the farm's end are killed.
inline constexpr double kHostGrace_s = 2;

class Host {
 public:
  enum class State : std::uint8_t {
    kJoining,  ///< has asked to join, and waits for the answer
    kJoined,
    kEnding,  ///< the farm ends, or the host leaves it: nodes are ending
    kOver,
  };

  /// `about` tells what the machine has.
  Host(control::Join about, double now_s);

  State state() const { return state_; }
  /// Why it is over; empty if the farm ended in order, or the host was asked to leave.
  const std::string& failure() const { return failure_; }

  void on_message(const ControlMessage& message, double now_s);
  /// A node's process has ended, or couldn't be started.
  void on_exit(const NodeExit& exit);
  /// Call now and then, before anything else of that moment. `has_nodes`: processes of nodes are
  /// there.
  void on_time(double now_s, bool has_nodes);
  /// The host is to leave the farm.
  void leave(double now_s);
  /// Why the frontal can't be reached, if the connection tells; then it isn't looked for any
  /// longer.
  void give_up(std::string why);

  /// Whether the connection to the frontal is to be made anew, before anything is sent: what was
  /// sent to a frontal that is gone must not reach the next one.
  bool take_reconnect() { return std::exchange(reconnects_, false); }
  std::vector<ControlMessage> take_outgoing() { return std::exchange(outgoing_, {}); }
  std::vector<NodeStart> take_starts() { return std::exchange(starts_, {}); }
  std::vector<NodeStart> take_kills() { return std::exchange(kills_, {}); }
  bool take_kill_all() { return std::exchange(kills_all_, false); }
  /// What the frontal has said of itself; nothing before it has answered.
  const std::optional<control::Joined>& farm() const { return farm_; }
  /// `stopped`: ranks of nodes whose processes something keeps from running.
  std::optional<std::uint64_t> take_ping() { return std::exchange(ping_, std::nullopt); }
  void answer_ping(std::uint64_t sequence, std::vector<std::uint32_t> stopped);

 private:
  void ask(double now_s);
  void drop_farm(double now_s);

  control::Join about_;
  State state_ = State::kJoining;
  double asked_s_ = 0, looks_since_s_ = 0, last_heard_s_ = 0, last_time_s_ = 0, ends_since_s_ = 0;
  std::string failure_;
  std::optional<control::Joined> farm_;
  std::optional<std::uint64_t> ping_;
  std::vector<ControlMessage> outgoing_;
  std::vector<NodeStart> starts_, kills_;
  bool kills_all_ = false, reconnects_ = false;
};

}  // namespace graycube
