#include "frontal/store/scene_folder.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "frontal/store/durable_file.hpp"
#include "frontal/store/job_files.hpp"
#include "proto/messages/values.hpp"

namespace graycube {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEnding = ".scene";

[[noreturn]] void fail(const fs::path& file, int error) {
  throw std::runtime_error(file.string() + ": " + std::generic_category().message(error));
}

/// Returns an errno or 0.
int write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(descriptor, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return errno;
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
  return 0;
}

/// A scene is its client's: only the store's owner may read it.
void write_file(const fs::path& file, std::span<const std::byte> bytes) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (descriptor < 0) fail(file, errno);
  const int error = write_all(descriptor, bytes);
  ::close(descriptor);
  if (error == 0) return;
  ::unlink(file.c_str());
  fail(file, error);
}

}  // namespace

std::vector<fs::path> scene_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator file(folder, error), end; !error && file != end;
       file.increment(error)) {
    if (job_of_file(file->path()) && file->path().extension() == kEnding)
      files.push_back(file->path());
  }
  return files;
}

fs::path SceneFolder::file(std::uint32_t job) const { return job_file(folder_, job, kEnding); }

void SceneFolder::keep_only(const std::vector<std::uint32_t>& jobs) const {
  for (const fs::path& file : scene_files(folder_)) {
    std::error_code ignored;
    if (std::ranges::find(jobs, *job_of_file(file)) == jobs.end()) fs::remove(file, ignored);
  }
}

void SceneFolder::write(std::uint32_t job, std::span<const std::byte> scene) const {
  const fs::path unfinished = file(job).string() + ".part";
  write_file(unfinished, scene);
  put_in_place(unfinished, file(job), is_durable_);
}

Bytes SceneFolder::read(std::uint32_t job) const {
  std::ifstream in(file(job), std::ios::binary | std::ios::ate);
  if (!in) fail(file(job), errno);
  const auto size = static_cast<std::size_t>(std::max<std::streamoff>(in.tellg(), 0));
  if (size > kMaxSubmitBytes) fail(file(job), EFBIG);
  Bytes bytes(size);
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!in) fail(file(job), EIO);
  return bytes;
}

}  // namespace graycube
