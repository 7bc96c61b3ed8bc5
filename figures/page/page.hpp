// What all figures have in common: colours, a head with title and subtitle, legends.
#pragma once

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "figures/page/svg.hpp"

namespace graycube::figures {

inline constexpr std::string_view kInk = "#1f2933", kQuiet = "#5f6c7b", kFaint = "#cbd2d9",
                                  kPanel = "#f5f7fa", kWhite = "#ffffff", kBlue = "#1c6dd0",
                                  kOrange = "#d9622b", kGreen = "#2b8a3e", kRed = "#c92a2a",
                                  kViolet = "#7048e8", kGold = "#f2b705";

/// Light to dark, for counts.
inline constexpr std::array<std::string_view, 7> kScale{"#eef4fb", "#d3e3f5", "#aacbeb", "#76abdc",
                                                        "#4384c5", "#1f5ea3", "#0b3c75"};

/// Where figures begin below the head, and what is left free at all sides.
inline constexpr double kHead = 74, kMargin = 28;

/// A white page with a title and a subtitle.
Svg begin_page(double width, double height, std::string_view title, std::string_view subtitle);

/// A sign and its meaning.
struct LegendEntry {
  enum class Sign { kLine, kDashes, kArea, kDot, kArrow };
  Sign sign = Sign::kLine;
  std::string_view color;
  std::string words;
};
/// Draws the entries in rows that are at most `width` wide, beginning at `at`.
void draw_legend(Svg& svg, Point at, double width, const std::vector<LegendEntry>& entries);

/// A time axis of `seconds` below a box: ticks at round milliseconds or microseconds, and the unit.
/// `first_s` is the time at its left end.
void draw_time_axis(Svg& svg, const Box& box, double first_s, double last_s);

/// The number of kScale's colour for a value, `most` the largest: 0 for 0 alone, then equal steps
/// of the square root, so that small values differ, too.
std::size_t shade_of(double value, double most);

}  // namespace graycube::figures
