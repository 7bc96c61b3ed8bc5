// What the command line takes, as values: what `--help` says, for completion and the man page.
#pragma once

#include <deque>
#include <string>
#include <vector>

namespace graycube {

/// What a value is, for who completes it.
enum class ValueKind {
  kText,
  kFile,
  kFolder,
  /// One of OptionDescription::choices.
  kChoice,
};

struct OptionDescription {
  /// As CLI11 takes them, "-o,--output"; a positional argument's one name, without dashes.
  std::string names = {};
  /// The placeholder, "OUT.exr"; empty: a flag, or a positional argument, whose name says it.
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

/// The parts of "-o,--output".
std::vector<std::string> names_of(const OptionDescription& option);

/// "-o, --output OUT.exr", or a positional argument's name.
std::string spelled(const OptionDescription& option);

}  // namespace graycube
