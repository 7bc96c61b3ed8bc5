// Texts as JSON strings.
#pragma once

#include <string>
#include <string_view>

namespace graycube {

/// The text in quotes, as JSON (RFC 8259) has it. Bytes that are no UTF-8 become U+FFFD.
std::string json_string(std::string_view text);

/// Seconds as a JSON number, to the millisecond.
std::string json_seconds(double seconds);

}  // namespace graycube
