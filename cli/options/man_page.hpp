// The manual page, graycube(1).
#pragma once

#include <string>

#include "cli/options/description.hpp"

namespace graycube {

/// The page in the macros of man(7).
std::string man_page(const CommandLineDescription& commands);

}  // namespace graycube
