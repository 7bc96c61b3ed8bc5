// The temporary folder of a farm whose jobs end with it, and those that farms have left which were
// killed.
#pragma once

#include <filesystem>

#include "process/temporary_folder.hpp"

namespace graycube {

/// A folder of one's own among the temporary files, for a job store. Its lock tells others that
/// somebody still removes it. Throws std::system_error when it can't be made.
class PassingFolder {
 public:
  PassingFolder();
  ~PassingFolder();
  PassingFolder(const PassingFolder&) = delete;
  PassingFolder& operator=(const PassingFolder&) = delete;

  const std::filesystem::path& path() const { return folder_.path(); }

 private:
  TemporaryFolder folder_;
  int lock_;
};

/// Removes the folders of this user's job stores that nobody uses any more: neither who made them,
/// nor their farm, holds a lock.
void clear_left_passing_folders();

}  // namespace graycube
