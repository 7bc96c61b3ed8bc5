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
  /// `endpoint`: the TCP endpoint; connections of others don't matter.
  explicit RefusalWatch(std::string endpoint) : endpoint_(std::move(endpoint)) {}
  /// What on_event() wants to hear of.
  static int events();
  /// `address_of(descriptor)` tells where an accepted connection comes from, and is asked at once.
  template <typename AddressOf>
  std::optional<TurnedAway> on_event(const SocketEvent& event, const AddressOf& address_of) {
    if (event.endpoint != endpoint_) return std::nullopt;
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

  std::string endpoint_;
  /// Connections that aren't known to be let in, by their descriptors.
  std::map<int, Guest> shaking_hands_;
  /// Why the connection that libzmq will say next to have been closed was refused: both are said by
  /// one thread, one after the other.
  std::optional<RefusalReason> reason_;
};

}  // namespace graycube
