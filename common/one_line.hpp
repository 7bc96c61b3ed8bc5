// Text that comes from elsewhere, made fit for a line of a log or a terminal.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace graycube {

/// The text as part of one line. Control characters, separators of lines, marks that turn the
/// direction of writing, and bytes that are no UTF-8 are written as escapes (`\n`, `\x1b`,
/// `\u202e`), and so are backslashes: nobody forges a line or commands a terminal. What would be
/// longer than `longest` bytes is cut, and ends with "…".
std::string one_line(std::string_view text, std::size_t longest);

}  // namespace graycube
