// One job store has one farm: a lock on a file of its folder, which ends with the process.
#pragma once

#include <filesystem>

namespace graycube {

class StoreLock {
 public:
  /// Throws std::runtime_error when another process holds it, which it names, or when the file
  /// can't be made.
  explicit StoreLock(const std::filesystem::path& folder);
  ~StoreLock();
  StoreLock(const StoreLock&) = delete;
  StoreLock& operator=(const StoreLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace graycube
