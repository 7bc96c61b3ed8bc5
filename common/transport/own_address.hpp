// Under which address others can reach this machine.
#pragma once

#include <string>

namespace graycube {

/// The address of this machine from which packets to a TCP endpoint go: "10.0.0.3", or
/// "[fd00::3]", as endpoints are written. Throws TransportError when no way leads there, or no
/// address is known of its name.
std::string own_address_towards(const std::string& endpoint);

}  // namespace graycube
