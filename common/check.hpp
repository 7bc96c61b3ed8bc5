// Assertions that stay on in release builds. A failure is a bug of this program, never bad input.
#pragma once

#include <cstdio>
#include <cstdlib>

/// Aborts with the condition, the place and a printf-style explanation when `condition` is false.
#define GRAYCUBE_CHECK(condition, ...)                                                  \
  do {                                                                                  \
    if (!(condition)) [[unlikely]] {                                                    \
      std::fprintf(stderr, "graycube: internal error: %s:%d: %s: ", __FILE__, __LINE__, \
                   #condition);                                                         \
      std::fprintf(stderr, __VA_ARGS__);                                                \
      std::fputc('\n', stderr);                                                         \
      std::abort();                                                                     \
    }                                                                                   \
  } while (false)
