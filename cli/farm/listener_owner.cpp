#include "cli/farm/listener_owner.hpp"

#include <netdb.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>
#include <sstream>

namespace graycube {
namespace {

/// The state of a listening socket in /proc/net/tcp (TCP_LISTEN of the kernel's tcp_states.h).
constexpr const char* kListening = "0A";

/// An address and port as /proc/net/tcp writes them (proc(5)): words of 32 bits in the machine's
/// byte order, and the port, in hexadecimal digits.
std::string as_in_proc(const void* address, std::size_t bytes, in_port_t port) {
  std::string text;
  std::array<char, 12> digits{};
  for (std::size_t at = 0; at < bytes; at += 4) {
    std::uint32_t word = 0;
    std::memcpy(&word, static_cast<const char*>(address) + at, sizeof word);
    std::snprintf(digits.data(), digits.size(), "%08X", word);
    text += digits.data();
  }
  std::snprintf(digits.data(), digits.size(), ":%04X", ntohs(port));
  return text + digits.data();
}

/// The owner of the listening socket with that local address in a table of sockets.
std::optional<uid_t> owner_in(const char* table, const std::string& local) {
  std::ifstream in(table);
  std::string line;
  std::getline(in, line);  // the headings
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    std::string number, found, peer, state, queues, timer, retries;
    uid_t owner = 0;
    fields >> number >> found >> peer >> state >> queues >> timer >> retries >> owner;
    if (fields && state == kListening && found == local) return owner;
  }
  return std::nullopt;
}

/// The owner of the listener at an address of one family, or at all addresses of it.
std::optional<uid_t> owner_at(const char* table, const void* address, std::size_t bytes,
                              in_port_t port) {
  if (const auto owner = owner_in(table, as_in_proc(address, bytes, port))) return owner;
  const std::array<char, 16> everywhere{};
  return owner_in(table, as_in_proc(everywhere.data(), bytes, port));
}

}  // namespace

std::optional<uid_t> owner_of_listener(const std::string& endpoint) {
  const std::string address = endpoint.substr(std::string("tcp://").size());
  const std::size_t colon = address.rfind(':');
  std::string host = address.substr(0, colon);
  if (host.starts_with("[") && host.ends_with("]")) host = host.substr(1, host.size() - 2);
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  if (::getaddrinfo(host.c_str(), address.substr(colon + 1).c_str(), &hints, &found) != 0)
    return std::nullopt;
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> list(found, &::freeaddrinfo);
  for (const addrinfo* a = found; a != nullptr; a = a->ai_next) {
    std::optional<uid_t> owner;
    if (a->ai_family == AF_INET) {
      sockaddr_in v4{};
      std::memcpy(&v4, a->ai_addr, sizeof v4);
      owner = owner_at("/proc/net/tcp", &v4.sin_addr, sizeof v4.sin_addr, v4.sin_port);
    } else if (a->ai_family == AF_INET6) {
      sockaddr_in6 v6{};
      std::memcpy(&v6, a->ai_addr, sizeof v6);
      owner = owner_at("/proc/net/tcp6", &v6.sin6_addr, sizeof v6.sin6_addr, v6.sin6_port);
    }
    if (owner) return owner;
  }
  return std::nullopt;
}

}  // namespace graycube
