// What goes wrong in a simulated farm.
#include <map>

#include "simulation/farm.hpp"

namespace graycube::simulation {

bool Farm::is_cut(Rank from, Place to) const {
  const auto cut = cut_until_s_.find({from, to});
  return cut != cut_until_s_.end() && timeline_.now_s() < cut->second;
}

bool Farm::is_alive(Rank rank, std::uint32_t incarnation) const {
  const Process& p = processes_[rank.value];
  return p.node && p.incarnation == incarnation;
}

std::vector<std::size_t> Farm::nodes_by_process() const {
  std::map<std::uint64_t, std::size_t> nodes;  // by process
  for (const Process& p : processes_) {
    if (p.node) ++nodes[p.pid];
  }
  std::vector<std::size_t> counts;
  for (const auto& [pid, count] : nodes) counts.push_back(count);
  return counts;
}

void Farm::happen(const Fault& fault) {
  if (fault.kind == Fault::Kind::kNoMoreStarts) {
    can_start_ = false;
    return;
  }
  if (fault.kind == Fault::Kind::kCut) {
    cut_until_s_[{fault.rank, fault.to}] = timeline_.now_s() + fault.lasts_s;
    return;
  }
  const Process& p = processes_[fault.rank.value];
  if (!p.node) return;
  const auto ended = end_process(p.pid);
  if (fault.kind == Fault::Kind::kStop) return;
  for (const Frontal::Process& node : ended) tell_of_end(node, true);
}

/// Ends all nodes of a process; returns them.
std::vector<Frontal::Process> Farm::end_process(std::uint64_t pid) {
  std::vector<Frontal::Process> ended;
  for (std::uint32_t rank = 0; rank < processes_.size(); ++rank) {
    Process& p = processes_[rank];
    if (!p.node || p.pid != pid) continue;
    p.node.reset();
    ended.push_back({Rank{rank}, p.incarnation});
  }
  return ended;
}

/// Trying takes a while, so that others that were started meanwhile have said hello.
void Farm::fail_to_start(const Frontal::Process& process) {
  timeline_.after(options_.heartbeat_s, [this, process] { tell_of_end(process, false); });
}

/// The frontal ends a process that has fallen silent.
void Farm::kill(const Frontal::Process& process) {
  if (is_alive(process.rank, process.incarnation)) end_process(processes_[process.rank.value].pid);
}

}  // namespace graycube::simulation
