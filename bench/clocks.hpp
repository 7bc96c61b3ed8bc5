// CPU time and memory of this process.
#pragma once

#include <malloc.h>
#include <sys/resource.h>

#include <cstdint>
#include <ctime>

namespace graycube::bench {

/// CPU seconds of the whole process, all threads together.
inline double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

class CpuClock {
 public:
  /// CPU seconds since the last lap, or since the clock was made.
  double lap() {
    const double now = cpu_seconds();
    const double passed = now - last_;
    last_ = now;
    return passed;
  }

 private:
  double last_ = cpu_seconds();
};

inline std::uint64_t peak_resident_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

/// Bytes that malloc has handed out, in all arenas, and mapped (glibc).
inline std::uint64_t heap_bytes() {
  const struct mallinfo2 info = mallinfo2();
  return info.uordblks + info.hblkhd;
}

}  // namespace graycube::bench
