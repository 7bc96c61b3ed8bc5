// graycube nodes: the processes of a farm.
#include <cstdio>

#include "cli/commands/commands.hpp"
#include "cli/display/job_text.hpp"
#include "cli/display/json_list.hpp"
#include "cli/farm/client.hpp"
#include "proto/control.hpp"

namespace graycube {

ExitStatus run(const NodesCommand& command) {
  FarmClient farm(command.connect);
  const auto [list, payload] = farm.ask<control::NodeList>(control::Nodes{}, "nodes");
  // The list has one kind of element: what hosts have is in the table alone.
  const std::string text = command.as_json
                               ? list_in(encode(control::NodeList{list.nodes, {}})) + "\n"
                               : nodes_text(list);
  std::fputs(text.c_str(), stdout);
  return ExitStatus::kDone;
}

}  // namespace graycube
