#pragma once

#include <stdlib.h>  // mkdtemp; NOLINT(modernize-deprecated-headers)

#include <cerrno>
#include <filesystem>
#include <string>
#include <system_error>

namespace graycube {

/// A folder of one's own among the temporary files, for sockets and the like; it is removed, with
/// all its contents, by the destructor. Throws std::system_error when it can't be made.
class TemporaryFolder {
 public:
  /// `prefix` should be short, since the path of a socket must be.
  explicit TemporaryFolder(const std::string& prefix = "graycube-") {
    std::string pattern = (std::filesystem::temp_directory_path() / (prefix + "XXXXXX")).string();
    if (::mkdtemp(pattern.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), pattern);
    }
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

}  // namespace graycube
