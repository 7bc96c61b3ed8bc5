// The options of the commands that list what a farm has: its jobs, and the lines of its log.
#pragma once

#include "cli/command_line.hpp"
#include "cli/options/declaring.hpp"

namespace graycube {

/// Declares which jobs are listed, and how.
void add_job_listing(Declaring& options, JobsCommand& jobs);
/// Declares which lines are printed, and how.
void add_log_listing(Declaring& options, LogCommand& log);

}  // namespace graycube
