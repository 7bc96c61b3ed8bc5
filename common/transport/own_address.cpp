#include "transport/own_address.hpp"

#include <netdb.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

#include "transport/zmq_sockets.hpp"

namespace graycube {
namespace {

class UdpSocket {
 public:
  explicit UdpSocket(int family) : descriptor_(::socket(family, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}
  ~UdpSocket() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  /// Sends nothing: the system only chooses the way, and with it the address.
  bool is_connected(const addrinfo& to) const {
    return descriptor_ >= 0 && ::connect(descriptor_, to.ai_addr, to.ai_addrlen) == 0;
  }
  /// Empty with errno, or with what getnameinfo() says.
  std::string own_address() const {
    sockaddr_storage own{};
    socklen_t size = sizeof own;
    auto* const generic = reinterpret_cast<sockaddr*>(&own);
    std::array<char, NI_MAXHOST> text{};
    if (::getsockname(descriptor_, generic, &size) != 0 ||
        ::getnameinfo(generic, size, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST) != 0)
      return "";
    return own.ss_family == AF_INET6 ? "[" + std::string(text.data()) + "]" : text.data();
  }

 private:
  int descriptor_;
};

}  // namespace

std::string own_address_towards(const std::string& endpoint) {
  const std::string address = endpoint.substr(std::string("tcp://").size());
  const std::size_t colon = address.rfind(':');
  std::string host = address.substr(0, colon);
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_socktype = SOCK_DGRAM;
  addrinfo* found = nullptr;
  const int unknown =
      ::getaddrinfo(host.c_str(), address.substr(colon + 1).c_str(), &hints, &found);
  if (unknown != 0) throw TransportError(endpoint + ": " + ::gai_strerror(unknown));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> list(found, &::freeaddrinfo);
  int error = 0;
  for (const addrinfo* a = found; a != nullptr; a = a->ai_next) {
    const UdpSocket socket(a->ai_family);
    if (socket.is_connected(*a)) {
      std::string own = socket.own_address();
      if (!own.empty()) return own;
    }
    error = errno;
  }
  throw TransportError(endpoint + ": " + std::strerror(error));
}

}  // namespace graycube
