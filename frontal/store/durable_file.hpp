// Files that are whole and stay so, whenever the machine stops.
#pragma once

#include <filesystem>

namespace graycube {

/// Puts a file that was written into its place under another name, in the same folder; if
/// `waits_for_disk`, once its contents are there. Throws std::runtime_error, which names the file.
void put_in_place(const std::filesystem::path& written, const std::filesystem::path& place,
                  bool waits_for_disk);

}  // namespace graycube
