// A file that appears whole or not at all.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>

namespace graycube {

/// A file written beside its target under a temporary name and renamed by `commit`; removed when
/// destroyed before that. A target that is a symbolic link stays one; a target that exists but is
/// no regular file (a folder, a device) is refused.
class WholeFile {
 public:
  /// Throws PictureError when the file can't be created.
  explicit WholeFile(const std::filesystem::path& target);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  /// These never throw, since they are called through libraries: after a failure they do nothing
  /// more, and `commit` reports the first one.
  bool write(const void* bytes, std::size_t count) noexcept;
  bool seek(std::uint64_t position) noexcept;
  std::uint64_t position() noexcept;
  bool failed() const noexcept { return error_ != 0; }

  /// Puts the file in its place, or throws PictureError.
  void commit();

 private:
  bool succeeded(bool success) noexcept;

  std::filesystem::path target_, temporary_;
  std::FILE* file_ = nullptr;
  int error_ = 0;  // the errno of the first failure
};

}  // namespace graycube
