// What becomes of a connection, told from what libzmq says of it. docs/design/processes.md has what
// it says in each case.
#pragma once

#include <chrono>
#include <optional>

#include "transport/handshake_trouble.hpp"
#include "transport/socket_monitor.hpp"

namespace graycube {

/// So often in a row a peer hangs up in the handshake until that is taken for its will: once may be
/// a farm that ends just then.
inline constexpr int kHangUpsMeant = 3;
/// A peer that has said nothing for so long after it accepted a connection is silent. libzmq
/// answers from a thread that has nothing else to do.
inline constexpr std::chrono::milliseconds kSilenceInHandshake{1500};

class ConnectionWatch {
 public:
  using Clock = std::chrono::steady_clock;
  /// What on_event() wants to hear of.
  static int events();
  void on_event(const SocketEvent& event, Clock::time_point now);
  bool is_lost() const { return is_lost_; }
  std::optional<HandshakeTrouble> trouble(Clock::time_point now) const;

 private:
  /// The connection has been closed in the handshake.
  void on_close();

  bool is_open_ = false, is_lost_ = false;
  /// Of the try that is under way: that a socket is connected, since when; and that libzmq has said
  /// how the handshake failed.
  std::optional<Clock::time_point> connected_at_;
  bool has_failed_ = false;
  int hang_ups_ = 0;
  std::optional<HandshakeTrouble> trouble_;
};

}  // namespace graycube
