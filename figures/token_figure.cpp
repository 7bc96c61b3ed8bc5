#include "figures/token_figure.hpp"

#include <algorithm>
#include <cmath>

#include "figures/page/page.hpp"
#include "figures/traffic_figure.hpp"

namespace graycube::figures {
namespace {

constexpr double kWidth = 1120, kPlotLeft = 88, kPlotHeight = 400, kHeight = 690;
constexpr std::size_t kMostRoundsListed = 6;
constexpr double kMarkWidth = 2.5;
/// How much of the time before the token sets out is shown, as a share of the time that it travels.
constexpr double kBefore = 0.25;

/// The nodes' places on the ring, by rank.
std::vector<std::uint32_t> ring_places(const Hypercube& cube) {
  std::vector<std::uint32_t> places(cube.nodes());
  Rank rank{0};
  for (std::uint32_t i = 0; i < cube.nodes(); ++i, rank = cube.ring_next(rank)) {
    places[rank.value] = i;
  }
  return places;
}

/// The plot: time to the right, the ring's nodes downward; node 0 again at the bottom, where rounds
/// end.
class Plot {
 public:
  Plot(const Hypercube& cube, double first_s, double last_s)
      : cube_(cube), places_(ring_places(cube)), first_s_(first_s), last_s_(last_s) {}

  Box box() const { return {kPlotLeft, kHead + 16, kWidth - kPlotLeft - kMargin, kPlotHeight}; }
  double first_s() const { return first_s_; }
  double last_s() const { return last_s_; }
  double x(double at_s) const {
    return box().x + (at_s - first_s_) / (last_s_ - first_s_) * box().width;
  }
  double row(std::uint32_t place) const {
    return box().y + (place + 0.5) / (cube_.nodes() + 1.0) * box().height;
  }
  double y(Rank rank) const { return row(places_[rank.value]); }
  /// Where a hop to the rank ends: round the ring to node 0, at the bottom.
  double y_of_arrival(Rank rank) const { return rank.value == 0 ? row(cube_.nodes()) : y(rank); }

  void draw_rows(Svg& svg) const {
    svg.rectangle(box(), {.fill = kPanel});
    Rank rank{0};
    const std::uint32_t step = cube_.nodes() > 32 ? 4 : 1;
    for (std::uint32_t i = 0; i <= cube_.nodes(); ++i, rank = cube_.ring_next(rank)) {
      svg.line({box().x, row(i)}, {box().right(), row(i)}, {.stroke = "#e1e6eb"});
      if (i % step != 0) continue;
      svg.text({box().x - 8, row(i) + 4}, "node " + std::to_string(rank.value),
               {.size = 11, .color = kQuiet, .anchor = Anchor::kEnd});
    }
  }

 private:
  const Hypercube& cube_;
  std::vector<std::uint32_t> places_;
  double first_s_, last_s_;
};

/// Each round twice: a dark rim, and the token's colour on it.
void draw_token(Svg& svg, const Plot& plot, const std::vector<TokenHop>& token) {
  for (const bool is_rim : {true, false}) {
    for (std::size_t i = 0; i < token.size(); ++i) {
      const TokenHop& hop = token[i];
      const std::string_view color = is_rim || hop.is_black ? kInk : kWhite;
      const Paint paint{.stroke = color, .width = is_rim ? 4.2 : 2.2};
      const Point arrival{plot.x(hop.arrived_s), plot.y_of_arrival(hop.to)};
      svg.line({plot.x(hop.sent_s), plot.y(hop.from)}, arrival, paint);
      if (i + 1 < token.size() && hop.to.value != 0) {
        svg.line(arrival, {plot.x(token[i + 1].sent_s), arrival.y}, paint);
      }
    }
  }
}

/// A mark for each node and each kMarkWidth of the page in which rays arrive there, so that a run
/// of many small messages gives no larger drawing.
void draw_rays(Svg& svg, const Hypercube& cube, const Plot& plot, const RunRecord& run) {
  const auto steps = static_cast<std::size_t>(plot.box().width / kMarkWidth) + 1;
  std::vector<std::vector<bool>> arrive(cube.nodes(), std::vector<bool>(steps));
  for (const RayShipment& s : run.shipments) {
    if (s.arrived_s < plot.first_s()) continue;
    const double step = (plot.x(s.arrived_s) - plot.box().x) / kMarkWidth;
    arrive[s.to.value][std::min(static_cast<std::size_t>(step), steps - 1)] = true;
  }
  std::string path;
  const double half = std::min(4.0, 0.4 * plot.box().height / (cube.nodes() + 1));
  for (std::uint32_t r = 0; r < cube.nodes(); ++r) {
    for (std::size_t i = 0; i < steps; ++i) {
      if (!arrive[r][i]) continue;
      const std::size_t first = i;
      while (i + 1 < steps && arrive[r][i + 1]) ++i;
      const double width = kMarkWidth * static_cast<double>(i - first + 1) - 0.5;
      path += "M" + coordinate(plot.box().x + kMarkWidth * static_cast<double>(first)) + " " +
              coordinate(plot.y(Rank{r}) - half) + "h" + coordinate(width) + "v" +
              coordinate(2 * half) + "h" + coordinate(-width) + "z";
    }
  }
  if (!path.empty()) svg.path(path, {.fill = kBlue, .opacity = 0.75});
}

std::string duration_of(const TokenRound& r) {
  const double took_s = r.ended_s - r.began_s;
  return took_s < 1e-3 ? figure_text(took_s * 1e6) + " µs" : figure_text(took_s * 1e3) + " ms";
}

std::string text_of(const TokenRound& r) {
  return "round " + std::to_string(r.round) + ": " + std::to_string(r.hops) + " hops, " +
         duration_of(r) + ", back " + (r.is_black ? "black" : "white") + ", its sum of messages " +
         std::to_string(r.count) + " before node 0 adds its own";
}

void draw_rounds(Svg& svg, const Plot& plot, const std::vector<TokenRound>& rounds) {
  const double y = plot.box().bottom() + 64;
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    const double x = plot.x(rounds[i].began_s);
    svg.line({x, plot.box().y}, {x, plot.box().bottom()},
             {.stroke = kOrange, .width = 1.2, .dashes = "3 3"});
    svg.text({x + 4, plot.box().y - 4}, std::to_string(rounds[i].round),
             {.size = 12, .color = kOrange, .is_bold = true});
    const bool is_listed =
        rounds.size() <= kMostRoundsListed || i + 2 < kMostRoundsListed || i + 1 == rounds.size();
    if (!is_listed) continue;
    const std::size_t line = std::min(i, kMostRoundsListed - 1);
    svg.text({kPlotLeft, y + 17.0 * static_cast<double>(line)}, text_of(rounds[i]),
             {.size = 12, .color = kQuiet});
  }
  if (rounds.size() > kMostRoundsListed) {
    svg.text({kPlotLeft, y + 17.0 * (kMostRoundsListed - 2)}, "\u2026",
             {.size = 12, .color = kQuiet});
  }
}

}  // namespace

std::vector<TokenRound> rounds_of(const RunRecord& run) {
  std::vector<TokenRound> rounds;
  for (const TokenHop& hop : run.token) {
    if (rounds.empty() || rounds.back().round != hop.round) {
      rounds.push_back({hop.round, 0, hop.sent_s, 0, false, 0});
    }
    TokenRound& round = rounds.back();
    ++round.hops;
    round.ended_s = hop.arrived_s;
    round.is_black = hop.is_black;
    round.count = hop.count;
  }
  return rounds;
}

std::string token_svg(std::string_view scene, const Hypercube& cube, const RunRecord& run) {
  const auto rounds = rounds_of(run);
  const double set_out_s = run.token.front().sent_s;
  const double first_s =
      std::max(0.0, set_out_s - std::max(kBefore * (run.end_s - set_out_s), 1e-6));
  const Plot plot(cube, first_s, run.end_s + 0.02 * (run.end_s - first_s));
  Svg svg = begin_page(
      kWidth, kHeight,
      std::string(scene) + ": the token on its ring of " + std::to_string(cube.nodes()) + " nodes",
      std::to_string(rounds.size()) + (rounds.size() == 1 ? " round, " : " rounds, ") +
          std::to_string(run.token.size()) + " hops; it sets out " + figure_text(set_out_s * 1e3) +
          " ms after the start, when node 0 is out of primary rays" + ending_text(run) +
          " (report, 3.3.4)");
  plot.draw_rows(svg);
  draw_rays(svg, cube, plot, run);
  draw_token(svg, plot, run.token);
  draw_rounds(svg, plot, rounds);
  draw_time_axis(svg, plot.box(), plot.first_s(), plot.last_s());
  draw_legend(svg, {kPlotLeft, kHeight - 24}, kWidth - kPlotLeft - kMargin,
              {{LegendEntry::Sign::kLine, kInk, "black token: a node passed had received rays"},
               {LegendEntry::Sign::kArea, kWhite, "white token (with a dark rim)"},
               {LegendEntry::Sign::kLine, kBlue, "rays arrive"},
               {LegendEntry::Sign::kDashes, kOrange, "a round begins"}});
  return svg.finish();
}

}  // namespace graycube::figures
