// Whether somebody listens at an endpoint, asked of the system itself: ZeroMQ connects to anything,
// in hope.
#pragma once

#include <sys/types.h>

#include <string>

namespace graycube {

struct Listener {
  bool is_there = false;
  /// Of a local socket, when this process may know it; else 0.
  pid_t process = 0;
};

/// `endpoint` must have no endpoint_problem().
Listener find_listener(const std::string& endpoint);

/// Removes the socket file of a process that has gone without doing so. Throws a Failure when the
/// path is taken by a file of another kind.
void remove_stale_socket(const std::string& endpoint);

}  // namespace graycube
