// Endpoints at which a farm may listen: only local sockets and loopback addresses, as long as links
// are neither encrypted nor authenticated.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace graycube {

/// The longest path of a local socket on Linux, without its terminating zero.
inline constexpr std::size_t kMaxSocketPath = 107;

/// Why `endpoint` ("ipc:///path", "tcp://127.0.0.1:5555", "tcp://[::1]:5555",
/// "tcp://localhost:5555"; port
/// "*" picks a free one) may not be used; nothing when it may.
std::optional<std::string> endpoint_problem(std::string_view endpoint);

/// The endpoint at which `graycube up` listens and clients connect by default: below
/// $XDG_RUNTIME_DIR, or in a folder of the user's in /tmp.
std::string default_endpoint();

}  // namespace graycube
