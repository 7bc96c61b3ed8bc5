// CPU time and memory of this process.
#pragma once

#include <malloc.h>
#include <sys/resource.h>

#include <cstdint>

#include "process/clocks.hpp"

namespace graycube::bench {

class CpuClock {
 public:
  /// CPU seconds since the last lap, or since the clock was made.
  double lap() {
    const double now = process_cpu_seconds();
    const double passed = now - last_;
    last_ = now;
    return passed;
  }

 private:
  double last_ = process_cpu_seconds();
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
