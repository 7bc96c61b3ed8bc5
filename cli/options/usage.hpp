// What is wrong with a command line, in words that tell how it is meant to be.
#pragma once

#include <string>
#include <vector>

#include "cli/failure.hpp"

namespace CLI {
class App;
class ParseError;
}  // namespace CLI

namespace graycube {

/// The words behind the program's name; `help` and `help COMMAND` are `--help` and `COMMAND
/// --help`.
std::vector<std::string> words_of(int argc, const char* const* argv);

/// Throws a usage failure unless the first word is the name of a command, or an option that stands
/// alone.
void check_command_name(const std::vector<std::string>& words,
                        const std::vector<std::string>& names);

/// The failure for what the parser finds.
Failure usage_failure_of(const CLI::App& app, const CLI::ParseError& e);

/// The failure with where to read on, unless it says that or has a guess. `command` may be empty.
Failure with_help(const Failure& failure, const std::string& command);

}  // namespace graycube
