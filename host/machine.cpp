#include "host/machine.hpp"

#include <sched.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

namespace graycube {
namespace {

/// Of control groups, version 2, as a container sees its own.
constexpr const char* kCpuQuota = "/sys/fs/cgroup/cpu.max";
constexpr const char* kMemoryLimit = "/sys/fs/cgroup/memory.max";

std::string first_word_of(const char* file) {
  std::string word;
  std::ifstream(file) >> word;
  return word;
}

std::string namespace_number(const char* file) {
  struct stat status {};
  return ::stat(file, &status) == 0 ? std::to_string(status.st_ino) : "?";
}

}  // namespace

std::string machine_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "?";
  return name.data();
}

std::string locality_tag() {
  return first_word_of("/proc/sys/kernel/random/boot_id") + ":" +
         namespace_number("/proc/self/ns/net") + ":" + namespace_number("/proc/self/ns/mnt") + ":" +
         std::to_string(::geteuid());
}

std::uint32_t usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::uint32_t cores = 1;
  if (::sched_getaffinity(0, sizeof set, &set) == 0)
    cores = static_cast<std::uint32_t>(std::max(1, CPU_COUNT(&set)));
  std::ifstream quota(kCpuQuota);
  double used = 0, period = 0;  // "max 100000" where there is no limit
  if (quota >> used >> period && used > 0 && period > 0)
    cores = std::min(cores, static_cast<std::uint32_t>(std::ceil(used / period)));
  return std::max(1u, cores);
}

std::uint64_t usable_memory_bytes() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), page = ::sysconf(_SC_PAGESIZE);
  std::uint64_t bytes = std::numeric_limits<std::uint64_t>::max();
  if (pages > 0 && page > 0)
    bytes = static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page);
  std::uint64_t limit = 0;  // "max" where there is none
  if (std::ifstream(kMemoryLimit) >> limit) bytes = std::min(bytes, limit);
  return bytes;
}

}  // namespace graycube
