#include "cli/options/declaring.hpp"

#include <CLI/CLI.hpp>
#include <utility>

#include "cli/failure.hpp"

namespace graycube {

namespace {

/// Refuses an empty name: it would stand for the option not being given.
std::function<void(const std::string&)> with_name(const std::string& option,
                                                  std::function<void(const std::string&)> take) {
  return [option, take = std::move(take)](const std::string& text) {
    if (text.empty()) throw usage_failure(option, "expected the name of a file, found nothing");
    take(text);
  };
}

}  // namespace

void Declaring::option(OptionDescription option, std::function<void(const std::string&)> take) {
  if (option.kind == ValueKind::kFile || option.kind == ValueKind::kFolder)
    take = with_name(names_of(option).front(), std::move(take));
  app_.add_option_function<std::string>(option.names, std::move(take), option.help)
      ->type_name(option.value)
      ->required(option.is_required)
      ->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  described_.options.push_back(std::move(option));
}

void Declaring::repeatable(OptionDescription option,
                           std::function<void(const std::vector<std::string>&)> take) {
  app_.add_option_function<std::vector<std::string>>(option.names, std::move(take), option.help)
      ->type_name(option.value)
      ->expected(1)
      ->take_all();
  option.is_repeatable = true;
  described_.options.push_back(std::move(option));
}

void Declaring::flag(const std::string& names, bool& is_given, const std::string& help) {
  app_.add_flag(names, is_given, help)->disable_flag_override();
  described_.options.push_back({.names = names, .help = help});
}

}  // namespace graycube
