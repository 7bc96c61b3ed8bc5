// Asks the system whose process listens at a TCP port.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

namespace graycube {

/// The user whose process listens at tcp://HOST:PORT on this machine; nothing when none does. Where
/// one listens at the very address and another at all addresses, the first gets connections.
std::optional<uid_t> owner_of_listener(const std::string& endpoint);

}  // namespace graycube
