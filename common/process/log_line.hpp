// A line of a log: when something happened, and what.
#pragma once

#include <string>
#include <string_view>

namespace graycube {

/// The most bytes of a line's text.
inline constexpr std::size_t kMaxLogText = 1000;

/// Unix time as "2026-11-30T17:05:59.123+01:00", by the clock on the wall here (ISO 8601).
std::string iso_time(double unix_s);

/// The line, with its end. The text is escaped and cut as one_line() does.
std::string log_line(double unix_s, std::string_view text);

}  // namespace graycube
