// Assertions that stay on in release builds. A failure is a bug of this program, never bad input.
#pragma once

#include <array>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace graycube {

/// A check that failed on a thread where ChecksThrow stands.
class InternalError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// As long as one stands on a thread, failed checks there throw an InternalError instead of ending
/// the process. For work on one job whose state is thrown away with it, so that others go on.
class ChecksThrow {
 public:
  ChecksThrow() : before_(is_on()) { is_on() = true; }
  ~ChecksThrow() { is_on() = before_; }
  ChecksThrow(const ChecksThrow&) = delete;
  ChecksThrow& operator=(const ChecksThrow&) = delete;

  static bool& is_on() {
    thread_local bool on = false;
    return on;
  }

 private:
  bool before_;
};

/// Tells of a failed check, in printf's way, and throws or aborts.
[[noreturn, gnu::noinline, gnu::cold, gnu::format(printf, 4, 5)]] inline void check_failed(
    const char* file, int line, const char* condition, const char* format, ...) {
  constexpr std::size_t kMostText = 500;
  std::array<char, kMostText> why{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(why.data(), why.size(), format, arguments);
  va_end(arguments);
  const std::string text =
      std::string(file) + ":" + std::to_string(line) + ": " + condition + ": " + why.data();
  if (ChecksThrow::is_on()) throw InternalError(text);
  std::fprintf(stderr, "graycube: internal error: %s\n", text.c_str());
  std::abort();
}

}  // namespace graycube

/// Fails with the condition, the place and a printf-style explanation when `condition` is false:
/// aborts, unless ChecksThrow stands on the thread.
#define GRAYCUBE_CHECK(condition, ...)                                       \
  do {                                                                       \
    if (!(condition)) [[unlikely]] {                                         \
      ::graycube::check_failed(__FILE__, __LINE__, #condition, __VA_ARGS__); \
    }                                                                        \
  } while (false)
