// What a simulated farm runs on: how long its links and processors take. The brains and what they
// compute are real; only time is not.
#pragma once

#include <cstddef>
#include <optional>

#include "simulation/doings.hpp"
#include "topology/rank.hpp"

namespace graycube::simulation {

/// A node, or the frontal.
using Place = std::optional<Rank>;

class Machine {
 public:
  virtual ~Machine() = default;
  /// A node's process has started (again).
  virtual void on_start(Rank) {}
  /// When a message that is handed to the link at `now_s` arrives. Messages of a link keep their
  /// order: a later call gives no earlier moment.
  virtual double arrival_s(Place from, Place to, std::size_t bytes, double now_s) = 0;
  /// The seconds of a core that these doings take.
  virtual double cpu_s(Place at, const PerUnit& doings) = 0;
  /// Cores that each node and the frontal have for themselves; 0: no limit.
  virtual unsigned own_cores() const { return 0; }
  /// Cores that all of them share instead; 0: none.
  virtual unsigned shared_cores() const { return 0; }
};

}  // namespace graycube::simulation
