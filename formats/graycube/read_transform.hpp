#pragma once

#include <optional>

#include "formats/json/access.hpp"
#include "geometry/affine.hpp"

namespace graycube {

/// Reads a `transform` list and composes it, first step innermost. Nothing when the list is empty
/// or, after reporting, when a step or the whole is not an invertible map of finite coefficients.
std::optional<Affine> read_transform(JsonAccess& json, JsonIndex at);

}  // namespace graycube
