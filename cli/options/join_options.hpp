// The options of `graycube join`.
#pragma once

#include "cli/options/declaring.hpp"

namespace graycube {

struct JoinCommand;

void add_join_options(Declaring& options, JoinCommand& join);

}  // namespace graycube
