// Records of tiles that are whole, so that another process goes on with a picture where one ended
// (docs/design/resuming.md describes the bytes). They tell pixels and exact sums, not numbers of
// tiles: a picture may go on with other tiles, on other nodes. Whoever reads takes any bytes: what
// isn't whole is passed over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "film/film.hpp"
#include "regions/macro_grid.hpp"

namespace graycube {

inline constexpr std::size_t kRecordsHeadBytes = 36;

/// The picture that records are of.
struct RecordedPicture {
  /// A digest of all that decides what the picture is: the scene, options, and the program's
  /// version.
  std::uint64_t content = 0;
  std::uint32_t width = 1, height = 1;
  AovSet aovs;
  friend bool operator==(const RecordedPicture&, const RecordedPicture&) = default;
};

/// What stands before the records. kRecordsHeadBytes bytes.
std::vector<std::byte> encode_records_head(const RecordedPicture& picture);
/// Nothing if the bytes don't begin with a head.
std::optional<RecordedPicture> decode_records_head(std::span<const std::byte> bytes);

/// Appends a record of a tile's pixels. One whose sums leave 64 bits is left out: it will be traced
/// again. The film must hold the tile's pixels.
void append_tile_record(std::vector<std::byte>& records, const Film& film, const PixelRect& tile);

/// Adds the pixels of all sound records behind a head to the film, which must be that of the head's
/// picture and hold nothing of them yet; each pixel once. Returns which pixels were added, row by
/// row.
std::vector<bool> restore_tiles(std::span<const std::byte> records, Film& film);

}  // namespace graycube
