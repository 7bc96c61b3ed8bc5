// A file in which `render --checkpoint` records the tiles that are whole, so that the same command
// goes on where it ended (docs/design/resuming.md).
#pragma once

#include <atomic>
#include <chrono>
#include <filesystem>
#include <mutex>
#include <vector>

#include "cli/scene_input.hpp"
#include "film/film.hpp"
#include "proto/records/tile_records.hpp"

namespace graycube {

/// The picture that a scene and options make: what decides it, and nothing that doesn't, such as
/// how many nodes render it.
RecordedPicture picture_of(const SceneInput& scene, const control::JobOptions& options);

class Checkpoint {
 public:
  /// Throws a Failure of status 2 when the file is there and is of another picture, or no
  /// checkpoint at all.
  Checkpoint(std::filesystem::path file, const RecordedPicture& picture);

  const std::filesystem::path& file() const { return file_; }
  const RecordedPicture& picture() const { return picture_; }

  /// Adds the tiles that were recorded to a film without light.
  void restore(Film& film);
  /// Whether some of the tile's pixels were not recorded; restore() must have been called.
  bool is_wanted(const PixelRect& tile) const;
  /// A tile is whole. For any thread.
  void note(const PixelRect& tile);
  /// Records what was noted, a few times a second, or now. For one thread at a time.
  void write(const Film& film, bool now);
  /// How many tiles restore() has spared, of those that is_wanted() was asked for.
  std::uint64_t resumed() const { return resumed_; }

  /// Removes the file, once the picture is written.
  void remove() noexcept;
  /// Says that the same command goes on from here, after an interrupt.
  void print_hint() const;

 private:
  std::filesystem::path file_;
  RecordedPicture picture_;
  std::vector<bool> known_;
  std::mutex mutex_;
  std::vector<PixelRect> whole_;
  std::chrono::steady_clock::time_point written_at_ = std::chrono::steady_clock::now();
  mutable std::atomic<std::uint64_t> resumed_{0};
};

}  // namespace graycube
