// How connections are accepted. Programs that link accept.cpp get its accept4() instead of the
// system's.
#pragma once

#include <cstdint>
#include <string>

namespace graycube {

/// From now on a connection is closed at once if its descriptor is a number above `last`, so that
/// at least so many others are open; but for those to the local socket at the path `spared`. To be
/// called before anybody listens.
void refuse_connections_above(int last, std::string spared);

/// The connections that were closed since this was last asked.
std::uint64_t take_refused_connections();

}  // namespace graycube
