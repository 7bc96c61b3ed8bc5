// Finds programs as a shell does.
#pragma once

#include <optional>
#include <string>

namespace graycube {

/// The path of a program: what the name says if it has a slash, else the first file of that name
/// that may be executed in a folder of $PATH; nothing if there is none.
std::optional<std::string> program_path(const std::string& name);

}  // namespace graycube
