#include "process/log_line.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "one_line.hpp"

namespace graycube {

std::string iso_time(double unix_s) {
  const double whole_s = std::floor(unix_s);
  const auto seconds = static_cast<std::time_t>(whole_s);
  const int milliseconds = static_cast<int>((unix_s - whole_s) * 1000);
  std::tm parts{};
  if (::localtime_r(&seconds, &parts) == nullptr) return "?";
  std::array<char, 32> day{};
  std::strftime(day.data(), day.size(), "%Y-%m-%dT%H:%M:%S", &parts);
  const long minutes = std::labs(parts.tm_gmtoff) / 60;
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%s.%03d%c%02ld:%02ld", day.data(), milliseconds,
                parts.tm_gmtoff < 0 ? '-' : '+', minutes / 60, minutes % 60);
  return text.data();
}

std::string log_line(double unix_s, std::string_view text) {
  return iso_time(unix_s) + " " + one_line(text, kMaxLogText) + "\n";
}

}  // namespace graycube
