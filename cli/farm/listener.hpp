// Asks the system whether a process listens at an endpoint: ZeroMQ itself connects to anything, in
// hope.
#pragma once

#include <sys/types.h>

#include <string>

namespace graycube {

struct Listener {
  bool is_there = false;
  /// The process that listens at a local socket; 0 when this process may not know it.
  pid_t process = 0;
};

/// `endpoint` must have no endpoint_problem().
Listener find_listener(const std::string& endpoint);

/// Removes the socket file of a process that ended without removing it. Throws a Failure when the
/// path is taken by a file of another kind.
void remove_stale_socket(const std::string& endpoint);

}  // namespace graycube
