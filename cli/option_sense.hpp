// Options of a render that would do nothing beside others.
#pragma once

#include "proto/messages.hpp"

namespace graycube {

/// Throws a usage failure for an option that the algorithm, or the flow, that is asked for has no
/// use for. Options that have the value that they have anyway count as not given.
void check_sense(const control::JobOptions& options);

}  // namespace graycube
