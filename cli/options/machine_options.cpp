#include "cli/options/machine_options.hpp"

#include <string>

#include "cli/option_values.hpp"
#include "topology/host_placement.hpp"

namespace graycube {
namespace {

constexpr std::uint32_t kMaxCores = 1u << 16;

}  // namespace

void add_machine(Declaring& options, SimulateCommand& c) {
  const auto figure = [&](const char* name, const char* type, const char* help, auto& value,
                          double least, double most) {
    options.option({.names = name, .value = type, .help = help},
                   [&value, name, least, most](const std::string& text) {
                     value = parse_number(name, text, least, most);
                   });
  };
  options.option(
      {.names = "--hosts",
       .value = "H",
       .help = "Hosts that the nodes lie on (default: a machine for each, and for each link)"},
      [&c](const std::string& text) { c.hosts = parse_count("--hosts", text, 1, kMaxHosts); });
  figure("--link-gbps", "G", "Bandwidth of a link, 10^9 bits a second (default 10)", c.link_gbps,
         1e-6, 1e6);
  figure("--link-us", "L", "Latency of a link, microseconds (default 50)", c.link_us, 0, 1e9);
  figure("--host-gbps", "G", "Bandwidth of the frontal's link (default: as the others)",
         c.host_gbps, 1e-6, 1e6);
  figure("--local-gbps", "G", "With --hosts: bandwidth between nodes of one (default 4.7)",
         c.local_gbps, 1e-6, 1e6);
  figure("--local-us", "L", "With --hosts: latency between nodes of one (default 20)", c.local_us,
         0, 1e9);
  figure("--message-us", "T", "CPU time that a message takes each side (default: measured here)",
         c.message_us, 0, 1e9);
  figure("--cpu-scale", "F", "How much longer than here evaluators take (default 1)", c.cpu_scale,
         1e-6, 1e9);
  options.option(
      {.names = "--cores",
       .value = "C",
       .help = "Cores that all processes, or those of each host, share (default: one each)"},
      [&c](const std::string& text) { c.cores = parse_count("--cores", text, 1, kMaxCores); });
}

}  // namespace graycube
