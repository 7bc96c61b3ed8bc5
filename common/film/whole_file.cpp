#include "film/whole_file.hpp"

#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "film/picture_files.hpp"

namespace graycube {
namespace {

constexpr int kMaxAttempts = 1000;

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& why) {
  throw PictureError("cannot write picture: " + path.string() + ": " + why);
}

[[noreturn]] void fail(const std::filesystem::path& path, int error) {
  fail(path, std::generic_category().message(error));
}

/// The file to which `path` leads, through symbolic links, if it exists; else `path`.
std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return path;
  if (std::filesystem::is_directory(status)) fail(path, EISDIR);
  // Renaming over a device would replace it.
  if (!std::filesystem::is_regular_file(status)) fail(path, "not a regular file");
  const auto canonical = std::filesystem::canonical(path, error);
  return error ? path : canonical;
}

}  // namespace

WholeFile::WholeFile(const std::filesystem::path& target) : target_(resolved(target)) {
  if (target_.filename().empty()) fail(target, "no file name");
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    temporary_ = target_;
    temporary_.replace_filename(".graycube-" + std::to_string(::getpid()) + "-" +
                                std::to_string(attempt) + ".tmp");
    const int descriptor =
        ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      file_ = ::fdopen(descriptor, "wb");
      if (file_ != nullptr) return;
      const int error = errno;
      ::close(descriptor);
      ::unlink(temporary_.c_str());
      fail(target, error);
    }
    if (errno != EEXIST) break;
  }
  if (errno == ENOENT) fail(target, "the folder does not exist");
  fail(target, errno);
}

WholeFile::~WholeFile() {
  if (file_ != nullptr) std::fclose(file_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

bool WholeFile::succeeded(bool success) noexcept {
  if (!success && error_ == 0) error_ = errno != 0 ? errno : EIO;
  return success;
}

bool WholeFile::write(const void* bytes, std::size_t count) noexcept {
  return error_ == 0 && succeeded(std::fwrite(bytes, 1, count, file_) == count);
}

bool WholeFile::seek(std::uint64_t position) noexcept {
  return error_ == 0 && succeeded(::fseeko(file_, static_cast<off_t>(position), SEEK_SET) == 0);
}

std::uint64_t WholeFile::position() noexcept {
  const off_t position = ::ftello(file_);
  return succeeded(position >= 0) ? static_cast<std::uint64_t>(position) : 0;
}

void WholeFile::commit() {
  if (error_ == 0) succeeded(std::fflush(file_) == 0);
  succeeded(std::fclose(std::exchange(file_, nullptr)) == 0);
  if (error_ == 0) succeeded(std::rename(temporary_.c_str(), target_.c_str()) == 0);
  if (error_ != 0) fail(target_, error_);
  temporary_.clear();
}

}  // namespace graycube
