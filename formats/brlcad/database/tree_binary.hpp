// Trees of combinations in binary databases.
#pragma once

#include <optional>
#include <string>

#include "formats/brlcad/database/byte_reader.hpp"
#include "formats/brlcad/database/database.hpp"

namespace graycube {

/// Reads a combination's body into its tree; a combination of nothing gets none. Returns what is
/// wrong with the body, if anything is.
std::optional<std::string> read_binary_tree(BrlcadByteReader& r, BrlcadComb& comb);

}  // namespace graycube
