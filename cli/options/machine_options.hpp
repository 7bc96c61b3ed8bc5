// Options of the machines that simulate assumes: links, hosts, processors.
#pragma once

#include "cli/command_line.hpp"
#include "cli/options/declaring.hpp"

namespace graycube {

void add_machine(Declaring& options, SimulateCommand& c);

}  // namespace graycube
