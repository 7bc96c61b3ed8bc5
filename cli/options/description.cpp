#include "cli/options/description.hpp"

#include <algorithm>

namespace graycube {

std::vector<std::string> names_of(const OptionDescription& option) {
  std::vector<std::string> names;
  for (std::size_t from = 0; from <= option.names.size();) {
    const std::size_t to = std::min(option.names.find(',', from), option.names.size());
    names.push_back(option.names.substr(from, to - from));
    from = to + 1;
  }
  return names;
}

std::string spelled(const OptionDescription& option) {
  std::string text;
  for (const std::string& name : names_of(option)) text += (text.empty() ? "" : ", ") + name;
  return option.value.empty() ? text : text + " " + option.value;
}

}  // namespace graycube
