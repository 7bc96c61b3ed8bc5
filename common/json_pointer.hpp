// JSON pointers (RFC 6901), with which errors tell their place.
#pragma once

#include <string>
#include <string_view>

namespace graycube {

/// Appends a member's name or an element's number: "~" is written ~0 and "/" ~1.
inline void append_token(std::string& pointer, std::string_view token) {
  pointer.push_back('/');
  for (const char c : token) {
    if (c == '~')
      pointer += "~0";
    else if (c == '/')
      pointer += "~1";
    else
      pointer.push_back(c);
  }
}

}  // namespace graycube
