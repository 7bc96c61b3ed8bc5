// One hypercube link as its sender and receiver see it: the outbox, credit in bytes, sequence
// numbers.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "node/class_places.hpp"
#include "node/outbox.hpp"
#include "topology/rank.hpp"

namespace graycube {

struct Link {
  Rank peer;
  bool is_greeted = false;

  Outbox outbox;
  /// What may still be sent before the peer grants more, in bytes of ray records.
  std::uint64_t send_credit = 0;
  std::uint64_t next_sequence = 0;

  /// A full node's rays for the peer that descend from rays on class credit; and the places that
  /// rays on class credit have taken, on the way to the peer and on the way here.
  std::vector<RayTask> class_outbox;
  ClassPlaces places_out, places_in;

  /// Taken from the inbox by evaluators, but not yet granted back.
  std::uint64_t ungranted = 0;
  std::uint64_t expected_sequence = 0;
  /// All that was granted to the peer, and by it, in bytes.
  std::uint64_t granted = 0, received = 0;

  /// What the peer was last told: that this node has nothing to do; and what it has told, until it
  /// gets something.
  bool has_offered = false;
  enum class Offer : std::uint8_t { kNone, kIdle, kIdleWithCopy } offer = Offer::kNone;
  /// What the peer had done by then, in tests of a primitive.
  std::uint64_t offered_after = 0;
  /// The frontal was asked to give the peer a copy of this node's slice.
  bool has_asked = false;

  void reset(std::uint64_t credit) {
    has_offered = false;
    offer = Offer::kNone;
    has_asked = false;
    outbox.clear();
    class_outbox.clear();
    places_out.clear();
    places_in.clear();
    send_credit = credit;
    ungranted = 0;
    next_sequence = 0;
    expected_sequence = 0;
    granted = 0;
    received = 0;
  }
};

}  // namespace graycube
