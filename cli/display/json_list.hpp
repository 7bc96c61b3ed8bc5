// Lists out of messages, as JSON for other programs.
#pragma once

#include <string>

namespace graycube {

/// The list in an encoded message whose only field is a list: `[…]` of `{"type": …, "jobs": […]}`.
inline std::string list_in(const std::string& message) {
  const std::size_t begin = message.find('['), end = message.rfind(']');
  return begin < end ? message.substr(begin, end - begin + 1) : "[]";
}

}  // namespace graycube
