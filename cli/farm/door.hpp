// Looks who listens at a farm's endpoint before anything is sent there.
#pragma once

#include <string>

#include "cli/farm/address.hpp"

namespace graycube {

/// Makes sure that nobody but this user can listen at the endpoint, and returns the key that is to
/// be shown there, empty if none is. A local socket and its folder must be this user's, and a TCP
/// port must be opened by a process of this user. Where others could listen, too, it waits for a
/// moment until somebody does. Throws a Failure.
std::string key_shown_at(const FarmAddress& farm);

}  // namespace graycube
