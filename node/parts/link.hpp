// One hypercube link, as the flow by credit sees it: the rays that wait to cross it, and the credit
// for more.
#pragma once

#include <cstdint>
#include <vector>

#include "node/parts/class_places.hpp"
#include "node/parts/outbox.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

struct Link {
  Outbox outbox;
  /// Bytes of ray records that may still be sent before the peer grants more.
  std::uint64_t send_credit = 0;
  /// A full node's rays for the peer that descend from rays on class credit; and the places that
  /// rays on class credit have taken, on the way to the peer and on the way here.
  std::vector<RayTask> class_outbox;
  ClassPlaces places_out, places_in;
  /// Bytes of rays that evaluators have taken from the inbox, but that are not granted back yet.
  std::uint64_t ungranted = 0;

  void reset(std::uint64_t credit) {
    outbox.clear();
    send_credit = credit;
    class_outbox.clear();
    places_out.clear();
    places_in.clear();
    ungranted = 0;
  }
};

}  // namespace graycube
