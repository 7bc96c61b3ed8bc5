// Which key a peer came in with.
#pragma once

#include <cstdint>

namespace graycube {

/// kNone: by a local socket, whose owner the peer is.
enum class PeerKey : std::uint8_t { kNone, kClient, kNode };

/// Domains of inboxes, as a Doorkeeper knows them.
inline constexpr const char* kNodesDomain = "nodes";
inline constexpr const char* kDoorDomain = "door";

}  // namespace graycube
