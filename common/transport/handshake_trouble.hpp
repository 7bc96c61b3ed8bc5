// What keeps a connection from being made, as each end sees it.
#pragma once

#include <cstdint>
#include <string>

namespace graycube {

/// Why a connection's peer can't be talked to.
enum class HandshakeTrouble : std::uint8_t {
  /// Nobody listens there, or no network leads there; ZeroMQ goes on trying.
  kNobody,
  /// Something listens, but has said nothing in time.
  kSilent,
  /// The peer knows the key that it is shown, and it isn't in its list.
  kNotAdmitted,
  /// It hangs up in each handshake: as a farm does that has another key, or what is no farm.
  kHangsUp,
  /// It speaks ZeroMQ, but without keys, or the peer wants a key and none was shown.
  kOtherMechanism,
  /// It doesn't speak ZeroMQ.
  kNotZmq,
};
/// A sentence's end: "FARM: ..." with what is wrong.
const char* sentence_of(HandshakeTrouble trouble);

/// Why an inbox hung up on somebody who connected.
enum class RefusalReason : std::uint8_t { kWrongKey, kNoKey, kNotZmq, kSilent };
const char* sentence_of(RefusalReason reason);

struct TurnedAway {
  /// Where it came from, "10.0.0.3"; empty if the system can't tell any more.
  std::string address;
  RefusalReason reason{};
  bool operator==(const TurnedAway&) const = default;
};

}  // namespace graycube
