#pragma once

#include <ctime>

namespace graycube::simulation {

/// CPU seconds that the calling thread has used so far.
inline double thread_cpu_seconds() {
  timespec t{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace graycube::simulation
