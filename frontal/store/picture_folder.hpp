// The pictures of a job store: a file for each job that is done.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "film/film.hpp"
#include "frontal/store/set_aside.hpp"

namespace graycube {

class PictureFolder {
 public:
  /// `is_durable`: pictures are on the disk before they count as kept.
  PictureFolder(std::filesystem::path folder, bool is_durable, Warn warn);

  /// Holds a picture in memory that was written or read, instead of the last one.
  void hold(std::uint32_t job, Picture picture);
  /// The picture that is held; null if it is of another job. Valid until the next call.
  const Picture* held(std::uint32_t job) const { return job == held_job_ ? &held_ : nullptr; }
  bool is_there(std::uint32_t job) const;
  void remove(std::uint32_t job) noexcept;

  // Any thread may call these.
  /// Throws std::runtime_error when the picture can't be written. `scene` is the scene's name.
  void write(std::uint32_t job, const Picture& picture, const std::string& scene) const;
  /// Nothing if there is none. A file that can't be read is set aside.
  std::optional<Picture> read(std::uint32_t job) const;

 private:
  std::filesystem::path file(std::uint32_t job) const;

  std::filesystem::path folder_;
  bool is_durable_;
  Warn warn_;
  /// Clients ask for a picture in several parts.
  std::uint32_t held_job_ = 0;
  Picture held_;
};

}  // namespace graycube
