// A machine described by a few figures: the cost of each unit of work, the speed of links, the
// number of cores.
#pragma once

#include <algorithm>
#include <map>
#include <utility>

#include "simulation/machine.hpp"

namespace graycube::simulation {

struct MachineFigures {
  /// Bandwidth of each link in each direction, and of the frontal's one link to all nodes, in 10⁹
  /// bits a second.
  double link_gbps = 10, host_gbps = 10;
  /// Microseconds from one end of a link to the other, beyond the time that the bytes take.
  double link_us = 50;
  /// Cores that all processes share; 0 gives each process one of its own.
  unsigned cores = 0;
  /// Factor by which evaluators are slower than here; the brains' work on messages is not scaled.
  double cpu_scale = 1;
  /// CPU seconds of each unit of work here.
  PerUnit costs;
};

class ModelledMachine : public Machine {
 public:
  explicit ModelledMachine(const MachineFigures& figures)
      : figures_(figures), costs_(figures.costs) {
    for (const Unit u : {Unit::kPiece, Unit::kRay, Unit::kVisit, Unit::kTest, Unit::kBuildByte}) {
      costs_[u] *= figures.cpu_scale;
    }
  }

  /// A link carries one message after another; all the frontal's messages share one link. Between
  /// processes of one node there is none.
  double arrival_s(Place from, Place to, std::size_t bytes, double now_s) override {
    if (from && from == to) return now_s;
    const bool is_host = !from || !to;
    double& free_at_s = !from ? from_host_s_ : !to ? to_host_s_ : links_[{from->value, to->value}];
    const double gbps = is_host ? figures_.host_gbps : figures_.link_gbps;
    free_at_s = std::max(free_at_s, now_s) + 8e-9 * static_cast<double>(bytes) / gbps;
    return free_at_s + 1e-6 * figures_.link_us;
  }
  double cpu_s(Place, const PerUnit& doings) override { return cost_of(doings, costs_); }
  unsigned own_cores() const override { return 1; }
  unsigned shared_cores() const override { return figures_.cores; }

 private:
  MachineFigures figures_;
  PerUnit costs_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> links_;
  double from_host_s_ = 0, to_host_s_ = 0;
};

}  // namespace graycube::simulation
