// Endpoints at which a farm may listen: local sockets, loopback addresses, and all others where
// there is a key.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace graycube {

/// The longest path of a local socket on Linux, without its terminating zero.
inline constexpr std::size_t kMaxSocketPath = 107;

/// Why `endpoint` ("ipc:///path", "tcp://127.0.0.1:5555", "tcp://[::1]:5555", "tcp://host:5555";
/// port "*" picks a free one) may not be used; nothing when it may. Off the loopback somebody must
/// have named a key. Host "*" is all of this machine's addresses, to listen at.
std::optional<std::string> endpoint_problem(std::string_view endpoint, bool has_key = false);

/// HOST of "tcp://HOST:PORT".
std::string tcp_host_of(std::string_view endpoint);

/// Whether only processes of this machine can reach the TCP endpoint: its host is in 127.0.0.0/8,
/// or is ::1 or localhost. False for what has an endpoint_problem(), and for local sockets.
bool is_on_loopback(std::string_view endpoint);

/// The user's folder for what a running farm needs: below $XDG_RUNTIME_DIR, or in /tmp.
std::string run_folder();

/// The endpoint at which `graycube up` listens and clients connect by default: a socket in the
/// run folder.
std::string default_endpoint();

}  // namespace graycube
