// Gets a farm its hosts from an allocation of Slurm, and gets them again when they are lost.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "frontal/slurm/step_processes.hpp"
#include "frontal/slurm/steps.hpp"

namespace graycube::slurm {

/// The hosts of an allocation, each with its CPUs.
using Hosts = std::vector<std::pair<std::string, std::uint32_t>>;

/// Reads "n1:4,n2:2"; nothing if it is no such text.
std::optional<Hosts> hosts_of(std::string_view text);

class Engine {
 public:
  /// `waits`: the farm was there before, and hosts may come back by themselves.
  Engine(const Hosts& hosts, StepSetting setting, bool waits, double now_s);

  /// Starts and ends steps; `here`: names of the hosts that have joined. Returns what people should
  /// be told.
  std::vector<std::string> work(const std::set<std::string>& here, double now_s);

 private:
  std::map<std::string, std::uint32_t> cpus_;
  Steps steps_;
  StepProcesses processes_;
};

}  // namespace graycube::slurm
