// One command's options, each declared once for two uses: to CLI11, which parses them and prints
// the help, and as a description, from which completion and the man page are made.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/options/description.hpp"

namespace CLI {
class App;
}

namespace graycube {

class Declaring {
 public:
  /// Both arguments must outlive this object and all that it declares.
  Declaring(CLI::App& app, CommandDescription& described) : app_(app), described_(described) {}

  /// An option with a value, or a positional argument; given at most once. `take` turns its text
  /// into a value, or throws a Failure.
  void option(OptionDescription option, std::function<void(const std::string&)> take);

  /// An option with one value that may be given many times; `take` gets all values.
  void repeatable(OptionDescription option,
                  std::function<void(const std::vector<std::string>&)> take);

  void flag(const std::string& names, bool& is_given, const std::string& help);

 private:
  CLI::App& app_;
  CommandDescription& described_;
};

}  // namespace graycube
