// Stands in for the system's accept4() in programs that link this file. libzmq 4.3.4 ends the
// process when there is no descriptor for a connection to a local socket (EMFILE in
// ipc_listener.cpp), but goes on when the whole system has none (ENFILE), so that is what it is
// told.
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

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
  return static_cast<int>(accepted);
}
