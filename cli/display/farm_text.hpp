// The texts that clients print about a farm itself.
#pragma once

#include <string>

#include "proto/messages.hpp"

namespace graycube {

/// A few lines of the form "name: value"; times are local.
std::string farm_text(const control::FarmInfo& farm);

/// One line of JSON: "pid", the frontal's process, numbers of nodes and jobs, and all about the
/// frontal as "frontal".
std::string farm_json(const control::FarmInfo& farm);

}  // namespace graycube
