#include "spelling.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace graycube {
namespace {

/// Longer strings are not compared: the cost is the product of the lengths.
constexpr std::size_t kMaxComparedLength = 64;
constexpr std::size_t kLeastBeginning = 3;

}  // namespace

std::size_t edit_distance(std::string_view a, std::string_view b) {
  // Three rows of the usual table: the row before the last, the last row, this row.
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::swap(before, last);
    std::swap(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string_view> closest(std::string_view written,
                                        std::span<const std::string_view> candidates) {
  if (written.size() > kMaxComparedLength) return std::nullopt;
  std::optional<std::string_view> best;
  std::size_t best_distance = 0;
  for (const auto candidate :
       candidates.first(std::min(candidates.size(), kMaxSpellingCandidates))) {
    if (candidate.size() > kMaxComparedLength) continue;
    const std::size_t longer = std::max(written.size(), candidate.size());
    const std::size_t shorter = std::min(written.size(), candidate.size());
    const std::size_t near_enough = std::max<std::size_t>(1, (longer + 1) / 3);
    const bool beginning =
        shorter >= kLeastBeginning && written.substr(0, shorter) == candidate.substr(0, shorter);
    if (!beginning && longer - shorter > near_enough) continue;
    const std::size_t distance = edit_distance(written, candidate);
    if ((beginning || distance <= near_enough) && (!best || distance < best_distance)) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string quoted(std::string_view s) {
  std::string text(1, '"');
  text.append(s);
  text.push_back('"');
  return text;
}

std::string did_you_mean(std::string_view written, std::span<const std::string_view> candidates) {
  const auto best = closest(written, candidates);
  return best ? "; did you mean " + quoted(*best) + "?" : std::string();
}

}  // namespace graycube
