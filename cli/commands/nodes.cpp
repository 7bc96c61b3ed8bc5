// graycube nodes: the processes of a farm.
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/display/job_text.hpp"
#include "cli/farm/client.hpp"

namespace graycube {

ExitStatus run(const NodesCommand& command) {
  FarmClient farm(command.connect);
  const auto [list, payload] = farm.ask<control::NodeList>(control::Nodes{}, "nodes");
  std::fputs(nodes_text(list.nodes).c_str(), stdout);
  return ExitStatus::kDone;
}

}  // namespace graycube
