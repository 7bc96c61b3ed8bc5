// One hypercube link, as the flow by credit sees it: what waits to cross it, and for how much there
// is credit.
#pragma once

#include <cstdint>
#include <vector>

#include "node/parts/class_places.hpp"
#include "node/parts/outbox.hpp"
#include "trace/ray_task.hpp"

namespace graycube {

struct Link {
  Outbox outbox;
  /// What may still be sent before the peer grants more, in bytes of ray records.
  std::uint64_t send_credit = 0;
  /// A full node's rays for the peer that descend from rays on class credit; and the places that
  /// rays on class credit have taken, on the way to the peer and on the way here.
  std::vector<RayTask> class_outbox;
  ClassPlaces places_out, places_in;
  /// Taken from the inbox by evaluators, but not yet granted back.
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
