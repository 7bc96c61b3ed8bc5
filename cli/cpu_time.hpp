#pragma once

#include <chrono>

namespace graycube {

/// Of wall time.
inline double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// User and system seconds that this process has used so far, all its threads together.
double own_cpu_seconds();

}  // namespace graycube
