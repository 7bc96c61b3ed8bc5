#include "transport/socket_monitor.hpp"

#include <atomic>
#include <cerrno>
#include <cstring>

namespace graycube {

SocketMonitor::SocketMonitor(zmq::context_t& context, zmq::socket_t& socket, int events)
    : watched_(socket) {
  // A name that no other monitor of this process has.
  static std::atomic<std::uint64_t> monitors{0};
  const std::string endpoint = "inproc://monitor-" + std::to_string(monitors.fetch_add(1));
  try {
    if (zmq_socket_monitor(socket.handle(), endpoint.c_str(), events) != 0) throw zmq::error_t();
    events_ = zmq::socket_t(context, zmq::socket_type::pair);
    events_.set(zmq::sockopt::linger, 0);
    // With a mark libzmq's thread would wait when it is reached.
    events_.set(zmq::sockopt::rcvhwm, 0);
    events_.connect(endpoint);
  } catch (const zmq::error_t& e) {
    throw TransportError(endpoint + ": " + e.what());
  }
}

SocketMonitor::~SocketMonitor() {
  if (watched_.handle() != nullptr) zmq_socket_monitor(watched_.handle(), nullptr, 0);
}

std::optional<SocketEvent> SocketMonitor::next() {
  for (;;) {
    zmq::message_t what, where;
    try {
      if (!events_.recv(what, zmq::recv_flags::dontwait)) return std::nullopt;
      // The second frame is there once the first is.
      if (what.more()) static_cast<void>(events_.recv(where, zmq::recv_flags::dontwait));
    } catch (const zmq::error_t& e) {
      if (e.num() == EINTR) continue;
      throw;
    }
    SocketEvent e;
    if (what.size() != sizeof e.event + sizeof e.value) continue;
    std::memcpy(&e.event, what.data(), sizeof e.event);
    std::memcpy(&e.value, static_cast<const char*>(what.data()) + sizeof e.event, sizeof e.value);
    e.endpoint = where.to_string();
    return e;
  }
}

}  // namespace graycube
