// Finds deadlocks of the historical flow: cycles of nodes that each hold a ray for which the next
// node's queue has no room.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "proto/messages.hpp"
#include "topology/hypercube.hpp"

namespace graycube {

class DeadlockWatch {
 public:
  explicit DeadlockWatch(const Hypercube& cube) : cube_(cube), reports_(cube.nodes()) {}

  /// A node's answer to a ping; `last_ping` is the newest that was sent. Returns the nodes of a
  /// cycle, each waiting for the next and the last for the first; empty while there is none.
  ///
  /// Two rounds of answers are compared, all of the first received before the second's ping was
  /// sent: a node that tells the same in both did nothing in between, so all such nodes were in
  /// that state at one moment. The room that one has granted equals the room that the other has
  /// received then, so no room was on its way either, and none will ever come.
  std::vector<Rank> add(Rank rank, const control::WaitReport& report, std::uint64_t last_ping);

  /// Nodes that were stalled in the newest complete round of answers.
  std::uint32_t stalled() const;

 private:
  using Round = std::vector<std::optional<control::WaitReport>>;
  std::optional<Rank> waits_for(Rank rank) const;
  std::vector<Rank> find_cycle() const;

  Hypercube cube_;
  Round reports_, earlier_;
  std::uint64_t ping_ = 0, next_after_ = 0;
  std::uint32_t count_ = 0;
};

}  // namespace graycube
