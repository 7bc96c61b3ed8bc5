// Who was hung up on at an inbox's TCP port, told from what libzmq says of its connections.
// docs/design/processes.md has what it says in each case.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "transport/handshake_trouble.hpp"
#include "transport/socket_monitor.hpp"

namespace graycube {

class RefusalWatch {
 public:
  /// What on_event() wants to hear of.
  static int events();
  /// `address_of(descriptor)` tells where an accepted connection comes from, and is asked at once.
  template <typename AddressOf>
  std::optional<TurnedAway> on_event(const SocketEvent& event, const AddressOf& address_of) {
    // An inbox has one TCP endpoint at most. Where that is all addresses of the machine, the event
    // names the one to which the peer has connected.
    if (!event.endpoint.starts_with("tcp://")) return std::nullopt;
    if (event.event == ZMQ_EVENT_ACCEPTED) {
      const int descriptor = static_cast<int>(event.value);
      shaking_hands_[descriptor] = {address_of(descriptor), false};
      return std::nullopt;
    }
    return on_end(event);
  }

 private:
  struct Guest {
    std::string address;
    /// libzmq doesn't say whose handshake succeeds.
    bool may_be_in = false;
  };

  std::optional<TurnedAway> on_end(const SocketEvent& event);
  void let_one_in();

  /// Connections that aren't known to be let in, by their descriptors.
  std::map<int, Guest> shaking_hands_;
  /// Why the connection that libzmq will say next to have been closed was refused: both are said by
  /// one thread, one after the other.
  std::optional<RefusalReason> reason_;
};

}  // namespace graycube
