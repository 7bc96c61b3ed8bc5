#include "figures/page/page.hpp"

#include <algorithm>
#include <cmath>

namespace graycube::figures {
namespace {

constexpr double kSignWidth = 22, kRowHeight = 19, kLegendSize = 12;
/// The mean width of a letter as a share of the letters' size, generously.
constexpr double kLetterWidth = 0.56;
constexpr int kMostTicks = 9;

double width_of(const LegendEntry& entry) {
  return kSignWidth + 8 + kLetterWidth * kLegendSize * static_cast<double>(entry.words.size()) + 18;
}

void draw_sign(Svg& svg, Point at, const LegendEntry& entry) {
  const Point end{at.x + kSignWidth, at.y};
  switch (entry.sign) {
    case LegendEntry::Sign::kLine: return svg.line(at, end, {.stroke = entry.color, .width = 3});
    case LegendEntry::Sign::kDashes:
      return svg.line(at, end, {.stroke = entry.color, .width = 2, .dashes = "5 3"});
    case LegendEntry::Sign::kArea:
      return svg.rectangle({at.x, at.y - 6, kSignWidth, 12},
                           {.fill = entry.color, .stroke = kQuiet, .width = 0.5});
    case LegendEntry::Sign::kDot:
      return svg.circle({at.x + kSignWidth / 2, at.y}, 5,
                        {.fill = entry.color, .stroke = kInk, .width = 0.8});
    case LegendEntry::Sign::kArrow: return svg.arrow(at, end, {.stroke = entry.color, .width = 2});
  }
}

/// The step between ticks: 1, 2 or 5 times a power of ten.
double round_step(double span) {
  const double least = span / kMostTicks;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (step * power >= least) return step * power;
  }
  return 10 * power;
}

}  // namespace

Svg begin_page(double width, double height, std::string_view title, std::string_view subtitle) {
  Svg svg(width, height, title);
  svg.text({kMargin, 34}, title, {.size = 20, .is_bold = true});
  svg.text({kMargin, 56}, subtitle, {.size = 13, .color = kQuiet});
  return svg;
}

void draw_legend(Svg& svg, Point at, double width, const std::vector<LegendEntry>& entries) {
  Point next = at;
  for (const LegendEntry& entry : entries) {
    if (next.x > at.x && next.x + width_of(entry) > at.x + width) {
      next = {at.x, next.y + kRowHeight};
    }
    draw_sign(svg, next, entry);
    svg.text({next.x + kSignWidth + 8, next.y + 4}, entry.words,
             {.size = kLegendSize, .color = kQuiet});
    next.x += width_of(entry);
  }
}

void draw_time_axis(Svg& svg, const Box& box, double first_s, double last_s) {
  const double span = last_s - first_s;
  if (!(span > 0)) return;
  const bool is_fine = span < 2e-3, is_coarse = span >= 10;
  const double unit = is_coarse ? 1 : is_fine ? 1e-6 : 1e-3;
  const double step = round_step(span / unit);
  svg.line({box.x, box.bottom()}, {box.right(), box.bottom()}, {.stroke = kQuiet});
  for (double tick = std::ceil(first_s / unit / step) * step; tick * unit <= last_s; tick += step) {
    const double x = box.x + (tick * unit - first_s) / span * box.width;
    svg.line({x, box.bottom()}, {x, box.bottom() + 5}, {.stroke = kQuiet});
    svg.text({x, box.bottom() + 18}, figure_text(tick),
             {.size = 11, .color = kQuiet, .anchor = Anchor::kMiddle});
  }
  svg.text({box.right(), box.bottom() + 34},
           std::string("simulated time, ") + (is_coarse ? "s"
                                              : is_fine ? "µs"
                                                        : "ms"),
           {.size = 12, .color = kQuiet, .anchor = Anchor::kEnd});
}

std::size_t shade_of(double value, double most) {
  if (!(value > 0) || !(most > 0)) return 0;
  const double share = std::sqrt(std::min(value / most, 1.0));
  const auto step = static_cast<std::size_t>(share * static_cast<double>(kScale.size() - 1));
  return std::clamp<std::size_t>(step + (share < 1 ? 1 : 0), 1, kScale.size() - 1);
}

}  // namespace graycube::figures
