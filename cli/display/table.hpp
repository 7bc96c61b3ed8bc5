// Columns for people.
#pragma once

#include <string>
#include <vector>

namespace graycube {

/// The rows, each as many cells as the first, which is the header; columns as wide as they need,
/// two spaces apart, no space at the end of a line.
std::string table_text(const std::vector<std::vector<std::string>>& rows);

}  // namespace graycube
