// Files of a job store that can't be read go to a folder of their own, where they are in nobody's
// way and can still be looked at.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace graycube {

/// Takes a sentence for the operator.
using Warn = std::function<void(const std::string&)>;

/// The folder below a store's in which damaged files lie.
inline constexpr const char* kDamagedFolder = "damaged";

/// Moves a file of the store in `folder` to its damaged ones, under another name if its own is
/// taken there, and says so. Never throws: what can't be moved is told, and stays.
void set_aside(const std::filesystem::path& folder, const std::filesystem::path& file,
               const std::string& why, const Warn& warn) noexcept;

}  // namespace graycube
