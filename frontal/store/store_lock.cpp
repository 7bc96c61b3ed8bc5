#include "frontal/store/store_lock.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <system_error>

namespace graycube {
namespace {

/// More bytes than a process's number has.
constexpr std::size_t kMostDigits = 24;

/// The process that a lock's file names, for people.
std::string holder_in(int descriptor) {
  std::array<char, kMostDigits + 1> text{};
  const ssize_t got = ::pread(descriptor, text.data(), kMostDigits, 0);
  const long pid = got > 0 ? std::strtol(text.data(), nullptr, 10) : 0;
  return pid > 0 ? "process " + std::to_string(pid) : "another process";
}

}  // namespace

StoreLock::StoreLock(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "lock";
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (descriptor_ < 0)
    throw std::runtime_error(file.string() + ": " + std::generic_category().message(errno));
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    const std::string why =
        errno == EWOULDBLOCK
            ? "is in use by the farm of " + holder_in(descriptor_) + "; a job store has one farm"
            : std::generic_category().message(errno);
    ::close(descriptor_);
    throw std::runtime_error(folder.string() + ": " + why);
  }
  const std::string pid = std::to_string(::getpid()) + "\n";
  // The name is for people only: the lock holds without it, on a full disk, say.
  if (::ftruncate(descriptor_, 0) == 0) {
    [[maybe_unused]] const auto written = ::pwrite(descriptor_, pid.data(), pid.size(), 0);
  }
}

StoreLock::~StoreLock() { ::close(descriptor_); }

}  // namespace graycube
