// Did-you-mean, and quotes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace graycube {

/// So many candidates are compared at most; scenes may name a million materials.
inline constexpr std::size_t kMaxSpellingCandidates = 4096;

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn one string into the
/// other, no character touched twice (optimal string alignment). Bytes, not characters; case
/// matters.
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The candidate nearest to what was written, if it is near enough to be what was meant: a third of
/// its characters changed, or one a beginning of the other (from three characters). The first of
/// equals.
std::optional<std::string_view> closest(std::string_view written,
                                        std::span<const std::string_view> candidates);

/// In double quotes.
std::string quoted(std::string_view s);

/// "; did you mean \"…\"?", or nothing.
std::string did_you_mean(std::string_view written, std::span<const std::string_view> candidates);

}  // namespace graycube
