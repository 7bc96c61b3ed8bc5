// Stands in for the system's accept4() in programs that link this file. libzmq 4.3.4 ends the
// process when there is no descriptor for a connection to a local socket (EMFILE in
// ipc_listener.cpp), but goes on when the whole system has none (ENFILE), so that is what it is
// told. It also goes on when a connection has been given up meanwhile (ECONNABORTED), which is what
// it is told of those that are refused.
#include "process/accept.hpp"

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/un.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <limits>
#include <utility>

namespace graycube {
namespace {

SparedListeners spared_listeners;
std::atomic<int> last_descriptor{std::numeric_limits<int>::max()};
std::atomic<std::uint64_t> refused{0};

bool is_spared(int listener) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size) != 0) return false;
  if (address.ss_family == AF_UNIX)
    return spared_listeners.path == reinterpret_cast<const sockaddr_un&>(address).sun_path;
  in_port_t port = 0;
  if (address.ss_family == AF_INET) port = reinterpret_cast<const sockaddr_in&>(address).sin_port;
  if (address.ss_family == AF_INET6)
    port = reinterpret_cast<const sockaddr_in6&>(address).sin6_port;
  return port != 0 && ntohs(port) == spared_listeners.port;
}

bool is_refused(int listener, long connection) {
  return connection > last_descriptor.load(std::memory_order_acquire) && !is_spared(listener);
}

}  // namespace

void refuse_connections_above(int last, SparedListeners spared) {
  spared_listeners = std::move(spared);
  last_descriptor.store(last, std::memory_order_release);
}

std::uint64_t take_refused_connections() { return refused.exchange(0); }

}  // namespace graycube

namespace {

/// The connection stays in the queue, and is asked for again at once: with a pause, that costs
/// little until another connection has ended.
constexpr useconds_t kPause_us = 2000;

}  // namespace

extern "C" int accept4(int socket, sockaddr* __restrict address, socklen_t* __restrict size,
                       int flags) {
  const long accepted = ::syscall(SYS_accept4, socket, address, size, flags);
  if (accepted < 0 && errno == EMFILE) {
    ::usleep(kPause_us);
    errno = ENFILE;
  }
  if (graycube::is_refused(socket, accepted)) {
    ::close(static_cast<int>(accepted));
    ++graycube::refused;
    errno = ECONNABORTED;
    return -1;
  }
  return static_cast<int>(accepted);
}
