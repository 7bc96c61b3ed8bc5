#include "frontal/store/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <stdexcept>
#include <system_error>

namespace graycube {
namespace {

namespace fs = std::filesystem;

/// Waits until the contents of a file, or the names in a folder, are on the disk.
void reach_disk(const fs::path& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  const bool is_there = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int error = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!is_there)
    throw std::runtime_error(path.string() + ": " + std::generic_category().message(error));
}

}  // namespace

void put_in_place(const fs::path& written, const fs::path& place, bool waits_for_disk) {
  if (waits_for_disk) reach_disk(written, O_RDONLY);
  std::error_code error;
  fs::rename(written, place, error);
  if (error) throw std::runtime_error(place.string() + ": " + error.message());
  if (waits_for_disk) reach_disk(place.parent_path(), O_RDONLY | O_DIRECTORY);
}

}  // namespace graycube
