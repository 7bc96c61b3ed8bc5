#include "node/guests.hpp"

#include <utility>

namespace graycube {

/// One at a time: an inbox is opened under a mask of permissions that is the whole process's.
void Guests::take_in(const control::Host& node) {
  const std::lock_guard lock(mutex_);
  Guest& guest =
      guests_.emplace_back(farm_, node, [this](const control::Host& further) { take_in(further); });
  guest.thread = std::thread([this, &guest, node] { run(guest.mailroom, Rank{node.rank}); });
}

void Guests::run(Mailroom& mailroom, Rank rank) {
  try {
    mailroom.run();
  } catch (const TransportError& e) {
    fail_(rank, e.what());
  }
}

/// Guests that are waited for may still take others in.
void Guests::wait() {
  for (std::size_t i = 0;; ++i) {
    std::thread ended;
    {
      const std::lock_guard lock(mutex_);
      if (i == guests_.size()) return;
      ended = std::move(guests_[i].thread);
    }
    if (ended.joinable()) ended.join();
  }
}

}  // namespace graycube
