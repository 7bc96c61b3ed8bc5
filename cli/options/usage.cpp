#include "cli/options/usage.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "spelling.hpp"

namespace graycube {
namespace {

/// "up", "up or jobs", "submit, jobs, status or another command".
std::string listed(const std::vector<std::string_view>& commands) {
  constexpr std::size_t kMost = 3;
  std::string text;
  const std::size_t shown = std::min(commands.size(), kMost);
  for (std::size_t i = 0; i < shown; ++i) {
    const bool is_last = i + 1 == commands.size();
    text += (i == 0 ? "" : is_last ? " or " : ", ") + std::string(commands[i]);
  }
  return commands.size() > kMost ? text + " or another command" : text;
}

/// The names of a command's options.
std::vector<std::string> option_names(const CLI::App& command) {
  std::vector<std::string> names;
  for (const CLI::Option* o : command.get_options()) {
    for (const std::string& name : o->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// The failure for an argument that no option of the command takes.
Failure unexpected(const CLI::App& app, const CLI::ExtrasError& e) {
  const auto chosen = app.get_subcommands();
  const CLI::App* sub = chosen.empty() ? &app : chosen.back();
  const auto extras = sub->remaining();
  if (extras.empty()) return usage_failure("", e.what());
  const std::string written = extras.front().substr(0, extras.front().find('='));
  if (!written.starts_with("-"))
    return usage_failure(sub->get_name(), "unexpected argument " + graycube::quoted(written));
  if (written == "-")
    return usage_failure(sub->get_name(),
                         "unexpected argument " + graycube::quoted(extras.front()));
  std::vector<std::string_view> others;
  for (const CLI::App* other : app.get_subcommands([](const CLI::App*) { return true; })) {
    const auto names = option_names(*other);
    if (std::find(names.begin(), names.end(), written) != names.end())
      others.push_back(other->get_name());
  }
  const std::string unknown = "unknown option " + graycube::quoted(written);
  // An option of other commands is what it says, not a slip of the pen.
  if (!others.empty())
    return usage_failure(sub->get_name(), unknown + "; " + listed(others) + " has it");
  const auto names = option_names(*sub);
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  return usage_failure(sub->get_name(), unknown + did_you_mean(written, candidates));
}

/// The failure for other errors that the parser finds, in our words.
Failure misused(const CLI::App& app, const CLI::ParseError& e) {
  const auto chosen = app.get_subcommands();
  const std::string where = chosen.empty() ? "" : chosen.back()->get_name();
  const std::string text = e.what();
  std::string name = text.substr(0, text.find_first_of(": "));
  // Of flags it has no dashes.
  if (!name.starts_with("-")) name.insert(0, name.size() == 1 ? "-" : "--");
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&e) != nullptr) {
    const bool is_flag = text.find("flag override") != std::string::npos;
    const bool is_missing = text.ends_with("missing");
    return usage_failure(where, name + (is_flag      ? " takes no value"
                                        : is_missing ? " needs a value"
                                                     : " is given twice"));
  }
  return usage_failure(where, text);
}

}  // namespace

Failure usage_failure_of(const CLI::App& app, const CLI::ParseError& e) {
  const auto* extras = dynamic_cast<const CLI::ExtrasError*>(&e);
  return extras != nullptr ? unexpected(app, *extras) : misused(app, e);
}

void check_command_name(const std::vector<std::string>& words,
                        const std::vector<std::string>& names) {
  if (words.empty()) throw usage_failure("", "expected a command; see 'graycube --help'");
  const std::string& written = words.front();
  if (written.starts_with("-")) {
    const std::vector<std::string_view> options{"--help", "--version", "-h", "-v"};
    if (std::find(options.begin(), options.end(), written) != options.end()) return;
    throw usage_failure(
        "", "unknown option " + graycube::quoted(written) + did_you_mean(written, options));
  }
  if (std::find(names.begin(), names.end(), written) != names.end()) return;
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  throw usage_failure(
      "", "unknown command " + graycube::quoted(written) + did_you_mean(written, candidates));
}

std::vector<std::string> words_of(int argc, const char* const* argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

Failure with_help(const Failure& failure, const std::string& command) {
  std::vector<Problem> problems = failure.problems();
  for (Problem& problem : problems) {
    const bool helps = problem.why.find("did you mean") != std::string::npos ||
                       problem.why.find("--help") != std::string::npos;
    if (problem.what == "usage" && !helps)
      problem.why += "; see 'graycube " + (command.empty() ? "" : command + " ") + "--help'";
  }
  return {failure.status(), std::move(problems)};
}

}  // namespace graycube
