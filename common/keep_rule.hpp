// How long a farm keeps jobs that have ended: `--keep N|DAYS`.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace graycube {

inline constexpr std::uint32_t kMaxJobsKept = 1'000'000;
inline constexpr std::uint32_t kMaxDaysKept = 36'500;

/// What is said of a rule that is none.
inline constexpr const char* kKeepRuleText =
    "expected a number of jobs, 1 to 1000000, or of days, 1d to 36500d";

/// At most one is not 0; both are where everything is kept.
struct KeepRule {
  /// The newest so many jobs are kept.
  std::uint32_t jobs = 0;
  /// Jobs that ended in the last so many days are kept.
  std::uint32_t days = 0;
  friend bool operator==(const KeepRule&, const KeepRule&) = default;
};

/// "500" for jobs, "30d" for days; nothing if it is neither, or out of range.
inline std::optional<KeepRule> parse_keep_rule(std::string_view text) {
  const bool is_days = text.ends_with('d');
  if (is_days) text.remove_suffix(1);
  std::uint32_t count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count == 0) return std::nullopt;
  if (count > (is_days ? kMaxDaysKept : kMaxJobsKept)) return std::nullopt;
  return is_days ? KeepRule{0, count} : KeepRule{count, 0};
}

}  // namespace graycube
