// Endpoints at which a farm may listen: only local sockets and loopback addresses, as long as what
// is said there isn't encrypted.
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

/// The user's folder for what a running farm needs: below $XDG_RUNTIME_DIR, or in /tmp.
std::string run_folder();

/// The endpoint at which `graycube up` listens and clients connect by default: a socket in the
/// run folder.
std::string default_endpoint();

}  // namespace graycube
