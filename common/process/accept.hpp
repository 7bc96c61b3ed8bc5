// How connections are accepted. Programs that link accept.cpp get its accept4() instead of the
// system's.
#pragma once

#include <cstdint>
#include <string>

namespace graycube {

/// Listeners whose connections are never too many: at a local socket's path, and at a TCP port (0
/// for none).
struct SparedListeners {
  std::string path;
  std::uint16_t port = 0;
};

/// From now on a connection is closed at once if its descriptor is a number above `last`, so that
/// at least so many others are open; but for those to spared listeners. To be called before others
/// listen.
void refuse_connections_above(int last, SparedListeners spared);

/// The connections that were closed since this was last asked.
std::uint64_t take_refused_connections();

}  // namespace graycube
