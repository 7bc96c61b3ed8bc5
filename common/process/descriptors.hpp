// How many files and sockets this process may have open at a time.
#pragma once

#include <cstdint>

namespace graycube {

/// Raises the process's limit to the most that the system lets it have, whatever `ulimit -n` says,
/// and returns that.
std::uint64_t raise_descriptor_limit();

}  // namespace graycube
