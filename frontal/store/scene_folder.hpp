// The long scenes of a job store: a file for each job that has one and has not ended.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include "transport/message.hpp"

namespace graycube {

/// The files of all scenes in a store's folder.
std::vector<std::filesystem::path> scene_files(const std::filesystem::path& folder);

class SceneFolder {
 public:
  /// `is_durable`: scenes are on the disk before they count as written.
  SceneFolder(std::filesystem::path folder, bool is_durable)
      : folder_(std::move(folder)), is_durable_(is_durable) {}

  std::filesystem::path file(std::uint32_t job) const;
  /// Removes the scenes of all other jobs: they have ended, or were never accepted.
  void keep_only(const std::vector<std::uint32_t>& jobs) const;

  // Any thread may call these. They throw std::runtime_error, which names the file and says why.
  void write(std::uint32_t job, std::span<const std::byte> scene) const;
  Bytes read(std::uint32_t job) const;

 private:
  std::filesystem::path folder_;
  bool is_durable_;
};

}  // namespace graycube
