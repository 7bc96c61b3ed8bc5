// What goes wrong in a simulated farm.
#include "simulation/farm.hpp"

namespace graycube::simulation {

bool Farm::is_cut(Rank from, Place to) const {
  const auto cut = cut_until_s_.find({from, to});
  return cut != cut_until_s_.end() && timeline_.now_s() < cut->second;
}

void Farm::happen(const Fault& fault) {
  if (fault.kind == Fault::Kind::kCut) {
    cut_until_s_[{fault.rank, fault.to}] = timeline_.now_s() + fault.lasts_s;
    return;
  }
  Process& p = processes_[fault.rank.value];
  if (!p.node) return;
  p.node.reset();
  if (fault.kind == Fault::Kind::kDeath) tell_of_death(fault.rank);
}

}  // namespace graycube::simulation
