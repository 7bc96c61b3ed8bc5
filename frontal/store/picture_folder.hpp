// The pictures of a job store: a file for each job that is done.
#pragma once

#include <cstdint>
#include <filesystem>

#include "film/film.hpp"
#include "frontal/store/set_aside.hpp"

namespace graycube {

class PictureFolder {
 public:
  /// `is_durable`: pictures are on the disk before they count as kept.
  PictureFolder(std::filesystem::path folder, bool is_durable, Warn warn);

  /// Throws std::runtime_error when the picture can't be kept. `scene` is the scene's name.
  void keep(std::uint32_t job, Picture picture, const std::string& scene);
  /// Null if there is none. A file that can't be read is set aside. Valid until the next call.
  const Picture* find(std::uint32_t job);
  void remove(std::uint32_t job) noexcept;

 private:
  std::filesystem::path file(std::uint32_t job) const;

  std::filesystem::path folder_;
  bool is_durable_;
  Warn warn_;
  /// The picture that was kept or found last: clients ask for one in several parts.
  std::uint32_t last_job_ = 0;
  Picture last_;
};

}  // namespace graycube
