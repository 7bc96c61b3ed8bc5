// The files that make shells complete the command line.
#pragma once

#include <string>
#include <string_view>

#include "cli/options/description.hpp"

namespace graycube {

enum class Shell { kBash, kZsh, kFish };

std::string_view to_string(Shell shell);

/// The file that the shell loads to complete `graycube`.
std::string completion_text(Shell shell, const CommandLineDescription& commands);

}  // namespace graycube
