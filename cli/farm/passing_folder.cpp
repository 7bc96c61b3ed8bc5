#include "cli/farm/passing_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <system_error>
#include <vector>

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrefix = "graycube-jobs-";
/// The file that a job store's farm locks (frontal/store/store_lock.cpp). It isn't there before a
/// farm has begun.
constexpr const char* kStoreLock = "lock";

/// A descriptor that holds the lock of a file or folder; -1 if there is none, it isn't one's own,
/// or somebody else holds it.
int lock_of(const fs::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC | flags);
  if (descriptor < 0) return -1;
  struct stat status {};
  if (::fstat(descriptor, &status) == 0 && status.st_uid == ::getuid() &&
      ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) {
    return descriptor;
  }
  ::close(descriptor);
  return -1;
}

void clear(const fs::path& folder) {
  const int maker = lock_of(folder, O_DIRECTORY);
  const int farm = maker >= 0 ? lock_of(folder / kStoreLock, 0) : -1;
  std::error_code ignored;
  if (farm >= 0) fs::remove_all(folder, ignored);
  for (const int lock : {farm, maker}) {
    if (lock >= 0) ::close(lock);
  }
}

}  // namespace

PassingFolder::PassingFolder() : folder_(kPrefix), lock_(lock_of(folder_.path(), O_DIRECTORY)) {}
PassingFolder::~PassingFolder() {
  if (lock_ >= 0) ::close(lock_);
}

void clear_left_passing_folders() {
  std::vector<fs::path> left;
  std::error_code error;
  const fs::path place = fs::temp_directory_path(error);
  for (fs::directory_iterator entry(place, error), end; !error && entry != end;
       entry.increment(error)) {
    if (entry->path().filename().string().starts_with(kPrefix)) left.push_back(entry->path());
  }
  for (const fs::path& folder : left) clear(folder);
}

}  // namespace graycube
