// Suggestions for misspelt words ("did you mean …?"), and quotes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace graycube {

/// The most candidates that are compared; scenes may name a million materials.
inline constexpr std::size_t kMaxSpellingCandidates = 4096;

/// The fewest insertions, deletions, replacements and swaps of neighbours that turn one string
/// into the other, none of whose bytes is touched twice (optimal string alignment). Case
/// matters.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to `written`, if it is near enough to be meant: at most about a third of
/// the characters differ, or one is a beginning of the other (of three characters or more). The
/// first of equally near ones.
std::optional<std::string_view> closest(std::string_view written,
                                        std::span<const std::string_view> candidates);

/// The string in double quotes.
std::string quoted(std::string_view s);

/// "; did you mean \"…\"?", or nothing.
std::string did_you_mean(std::string_view written, std::span<const std::string_view> candidates);

}  // namespace graycube
