// What libzmq tells of the connections of a socket (zmq_socket_monitor).
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "transport/zmq_context.hpp"

namespace graycube {

/// An event: which (ZMQ_EVENT_...), its value, and the endpoint of the socket that it belongs to.
struct SocketEvent {
  std::uint16_t event = 0;
  std::uint32_t value = 0;
  std::string endpoint;
};

/// Events are kept until they are taken, any number of them: what waits must never hold up libzmq.
class SocketMonitor {
 public:
  /// `events`: those to be told, ZMQ_EVENT_... Throws TransportError. The socket must live longer.
  SocketMonitor(zmq::context_t& context, zmq::socket_t& socket, int events);
  ~SocketMonitor();
  SocketMonitor(const SocketMonitor&) = delete;
  SocketMonitor& operator=(const SocketMonitor&) = delete;
  /// Nothing when no event is there.
  std::optional<SocketEvent> next();

 private:
  zmq::socket_t& watched_;
  zmq::socket_t events_;
};

}  // namespace graycube
