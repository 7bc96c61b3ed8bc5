// The texts that clients print about jobs and nodes.
#pragma once

#include <string>
#include <vector>

#include "proto/messages.hpp"

namespace graycube {

/// A table with a line for each job; times are local.
std::string jobs_text(const std::vector<control::JobInfo>& jobs);

/// A few lines of the form "name: value".
std::string job_text(const control::JobInfo& job);

/// A table with a line for each node; behind it a sentence about each process that is several, and
/// a table of the hosts if the nodes have some.
std::string nodes_text(const control::NodeList& list);

}  // namespace graycube
