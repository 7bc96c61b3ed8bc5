// The machine that a simulated farm runs on: it says how long links and processors take. The brains
// and their results are real; only time is not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "simulation/doings.hpp"
#include "topology/rank.hpp"

namespace graycube::simulation {

/// A node, or the frontal.
using Place = std::optional<Rank>;

class Machine {
 public:
  virtual ~Machine() = default;
  /// Told that a node's process has started, perhaps again.
  virtual void on_start(Rank) {}
  /// The moment at which a message arrives that is handed to the link at `now_s`. Messages of a
  /// link keep their order: a later call gives no earlier moment. `from` and `to` are the same node
  /// for messages between it and the process that holds its FIFO.
  virtual double arrival_s(Place from, Place to, std::size_t bytes, double now_s) = 0;
  /// The core seconds that this work takes.
  virtual double cpu_s(Place at, const PerUnit& doings) = 0;
  /// Cores that each node, and the frontal, has for itself; 0 for no limit.
  virtual unsigned own_cores() const { return 0; }
  /// Cores that all of a host share instead; 0 if they share none.
  virtual unsigned shared_cores() const { return 0; }
  /// Hosts, the frontal's included. What is sent from one to another is ciphered.
  virtual std::uint32_t hosts() const { return 1; }
  /// The host of a node or of the frontal, below hosts().
  virtual std::uint32_t host_of(Place) const { return 0; }
};

}  // namespace graycube::simulation
