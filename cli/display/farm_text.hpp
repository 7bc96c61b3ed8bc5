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

/// A line of the farm's log as `graycube up --log` writes it, and as a line of JSON.
std::string log_text(const control::LogLine& line);
std::string log_json(const control::LogLine& line);

}  // namespace graycube
