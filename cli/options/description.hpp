// The command line as values, from which `--help`, completion and the man page are made.
#pragma once

#include <deque>
#include <string>
#include <vector>

namespace graycube {

/// The kind of a value, which completion needs to know.
enum class ValueKind {
  kText,
  kFile,
  kFolder,
  /// One of OptionDescription::choices.
  kChoice,
};

struct OptionDescription {
  /// Names in CLI11's form, "-o,--output"; for a positional argument its one name, without dashes.
  std::string names = {};
  /// The value's placeholder, "OUT.exr"; empty for a flag, and for a positional argument.
  std::string value = {};
  std::string help = {};
  ValueKind kind = ValueKind::kText;
  std::vector<std::string> choices = {};
  bool is_required = false, is_repeatable = false;

  bool is_positional() const { return !names.starts_with("-"); }
  bool is_flag() const { return !is_positional() && value.empty(); }
};

struct CommandDescription {
  std::string name, help;
  std::vector<OptionDescription> options;
};

/// All commands, in the help's order. References to them stay good while others are added.
using CommandLineDescription = std::deque<CommandDescription>;

/// The single names in "-o,--output".
std::vector<std::string> names_of(const OptionDescription& option);

/// The names as help shows them: "-o, --output OUT.exr", or a positional argument's name.
std::string spelled(const OptionDescription& option);

}  // namespace graycube
