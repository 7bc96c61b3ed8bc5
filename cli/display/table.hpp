// Tables of text for people.
#pragma once

#include <string>
#include <vector>

namespace graycube {

/// The rows as text. All have as many cells as the first, which is the header; columns are as wide
/// as they need, two spaces apart, with no space at the end of a line.
std::string table_text(const std::vector<std::vector<std::string>>& rows);

/// The value as a C format for one double writes it ("%.2f"), at most 63 characters.
std::string number_text(const char* format, double value);

}  // namespace graycube
