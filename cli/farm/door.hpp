// Looks who listens at a farm's endpoint before anything is sent there.
#pragma once

#include <optional>

#include "cli/farm/address.hpp"
#include "transport/curve_keys.hpp"

namespace graycube {

/// Makes sure that nobody but this user can listen at the endpoint, and returns the keys that are
/// to be shown there, none at a local socket. That and its folder must be this user's, and a port
/// of the loopback must be opened by a process of this user. Where others could listen, too, it
/// waits for a moment until somebody does. Of other machines nobody can tell; there the farm must
/// show that it has the key. Throws a Failure.
std::optional<CurveAccess> access_to(const FarmAddress& farm);

}  // namespace graycube
