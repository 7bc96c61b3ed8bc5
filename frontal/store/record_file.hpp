// A file of records of tiles, read when a picture goes on.
#pragma once

#include <cstdint>
#include <filesystem>

#include "transport/message.hpp"

namespace graycube {

/// A larger file is no record of a picture: each of its pixels takes at most 66 bytes, and its
/// tiles little.
inline constexpr std::uintmax_t kMaxRecordFileBytes = std::uintmax_t{8} << 30;

/// All bytes of the file; none if it isn't there or can't be read.
Bytes read_record_file(const std::filesystem::path& file);

}  // namespace graycube
