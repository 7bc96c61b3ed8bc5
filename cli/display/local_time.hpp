// Times of day for people.
#pragma once

#include <array>
#include <ctime>
#include <string>

namespace graycube {

/// Unix time as "2026-11-30 17:05:59", by the clock on the wall here.
inline std::string local_time(double unix_s) {
  const auto seconds = static_cast<std::time_t>(unix_s);
  std::tm parts{};
  if (::localtime_r(&seconds, &parts) == nullptr) return "?";
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M:%S", &parts);
  return text.data();
}

}  // namespace graycube
