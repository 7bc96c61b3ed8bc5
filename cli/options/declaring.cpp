#include "cli/options/declaring.hpp"

#include <CLI/CLI.hpp>
#include <utility>

namespace graycube {

void Declaring::option(OptionDescription option, std::function<void(const std::string&)> take) {
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
  app_.add_flag(names, is_given, help);
  described_.options.push_back({.names = names, .help = help});
}

}  // namespace graycube
