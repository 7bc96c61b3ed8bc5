#include "transport/tcp_options.hpp"

#include <netdb.h>
#include <sys/socket.h>

#include <array>
#include <string_view>

namespace graycube {
namespace {

/// Of zmq.h's draft part, so that cppzmq has no name for it; libzmq has had it since 4.3.0. With it
/// nobody gets in where no Doorkeeper is.
constexpr int kZapEnforceDomain = 93;

void tune(zmq::socket_t& socket, const std::string& endpoint) {
  socket.set(zmq::sockopt::tcp_keepalive, 1);
  socket.set(zmq::sockopt::tcp_keepalive_idle, kIdle_s);
  socket.set(zmq::sockopt::tcp_keepalive_intvl, kProbeInterval_s);
  socket.set(zmq::sockopt::tcp_keepalive_cnt, kProbes);
  socket.set(zmq::sockopt::tcp_maxrt, kUnacknowledged_ms);
  // For names it would prefer addresses at which nobody may listen.
  if (endpoint.find('[') != std::string::npos) socket.set(zmq::sockopt::ipv6, true);
}

}  // namespace

bool is_tcp(const std::string& endpoint) { return endpoint.starts_with("tcp://"); }

void make_keyed(zmq::socket_t& socket, const std::string& endpoint, const CurveAccess& access) {
  tune(socket, endpoint);
  socket.set(zmq::sockopt::curve_serverkey, zmq::buffer(access.server));
  socket.set(zmq::sockopt::curve_publickey, zmq::buffer(access.own.public_key));
  socket.set(zmq::sockopt::curve_secretkey, zmq::buffer(access.own.secret_key));
}

void make_keyed_door(zmq::socket_t& socket, const KeyedDoor& door) {
  tune(socket, door.endpoint);
  const int on = 1;
  if (zmq_setsockopt(socket.handle(), kZapEnforceDomain, &on, sizeof on) != 0) throw zmq::error_t();
  socket.set(zmq::sockopt::zap_domain, door.domain);
  socket.set(zmq::sockopt::curve_server, true);
  socket.set(zmq::sockopt::curve_secretkey, zmq::buffer(door.keys.secret_key));
}

const char* user_of(PeerKey key) {
  switch (key) {
    case PeerKey::kNone: return "";
    case PeerKey::kClient: return "client";
    case PeerKey::kNode: return "node";
  }
  return "";
}

PeerKey key_of_sender(const zmq::message_t& received) {
  const auto property = [&](const char* name) {
    const char* value = zmq_msg_gets(received.handle(), name);
    return std::string_view(value == nullptr ? "" : value);
  };
  // Peers at local sockets aren't asked for keys, but could say anything of themselves.
  if (property("Peer-Address").starts_with("localhost:")) return PeerKey::kNone;
  const std::string_view user = property("User-Id");
  for (const PeerKey key : {PeerKey::kClient, PeerKey::kNode}) {
    if (user == user_of(key)) return key;
  }
  return PeerKey::kNone;
}

std::string address_of_peer(int descriptor) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  std::array<char, NI_MAXHOST> text{};
  auto* const generic = reinterpret_cast<sockaddr*>(&address);
  if (::getpeername(descriptor, generic, &size) != 0 ||
      ::getnameinfo(generic, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) != 0)
    return "";
  return text.data();
}

}  // namespace graycube
