#include "cli/options/join_options.hpp"

#include "cli/command_line.hpp"
#include "cli/option_values.hpp"

namespace graycube {

void add_join_options(Declaring& options, JoinCommand& join) {
  options.option(
      {.names = "ENDPOINT", .help = "Where the farm listens: tcp://HOST:PORT", .is_required = true},
      [&join](const std::string& text) { join.endpoint = text; });
  options.option({.names = "--key",
                  .value = "FILE",
                  .help = "The farm's key; - reads it from standard input",
                  .kind = ValueKind::kFile},
                 [&join](const std::string& text) { join.key = text; });
  options.option({.names = "--slots",
                  .value = "N",
                  .help = "Nodes that this host is meant for (default: its cores)"},
                 [&join](const std::string& text) {
                   join.slots = parse_count("--slots", text, 1, kMaxNodes);
                 });
  options.option({.names = "--name",
                  .value = "NAME",
                  .help = "What the farm calls this host (default: its host name)"},
                 [&join](const std::string& text) { join.name = text; });
  options.option({.names = "--address",
                  .value = "ADDRESS",
                  .help = "Where nodes listen for those of other hosts (default: the address from "
                          "which the farm is reached)"},
                 [&join](const std::string& text) { join.address = text; });
}

}  // namespace graycube
