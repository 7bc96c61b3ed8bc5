// A host's process: wires its brain to the frontal, to nodes' processes, signals and clocks.
#pragma once

#include <string>

#include "host/host.hpp"
#include "transport/curve_keys.hpp"

namespace graycube {

struct HostSetting {
  /// The door at which the farm's clients come in, too: "tcp://10.0.0.1:7411".
  std::string endpoint;
  FarmKeys keys;
  /// What the machine has; its folder is made here.
  control::Join about;
  /// The address at which its nodes listen for those of other hosts; empty for the one from which
  /// the frontal is reached.
  std::string address;
  /// The program graycube-node.
  std::string node_program;
};

/// Joins the farm and runs nodes as it is told, until the farm ends, or SIGTERM, SIGINT or SIGHUP
/// asks the host to leave; those must be blocked. Returns why it ended otherwise; empty if it
/// didn't. Throws TransportError, and std::system_error when the system has no room.
std::string run_host(const HostSetting& setting);

}  // namespace graycube
