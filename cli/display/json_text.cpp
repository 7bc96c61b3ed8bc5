#include "cli/display/json_text.hpp"

#include <array>
#include <cstddef>
#include <cstdio>

#include "utf8.hpp"

namespace graycube {
std::string json_string(std::string_view text) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string quoted = "\"";
  while (!text.empty()) {
    const std::size_t length = utf8_bytes(text);
    const auto c = static_cast<unsigned char>(text.front());
    if (length == 0) {
      quoted += "\xEF\xBF\xBD";
    } else if (c == '"' || c == '\\') {
      quoted += {'\\', text.front()};
    } else if (c < 0x20) {
      quoted += std::string("\\u00") + kHex[c >> 4] + kHex[c & 15];
    } else {
      quoted += text.substr(0, length);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  return quoted + '"';
}

std::string json_seconds(double seconds) {
  // The longest double has 309 digits before its point.
  std::array<char, 328> text{};
  std::snprintf(text.data(), text.size(), "%.3f", seconds);
  return text.data();
}

}  // namespace graycube
