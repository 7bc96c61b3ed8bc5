// Figures of a run show what its statistics count.
#include <nlohmann/json.hpp>
#include <numeric>

#include "catch.hpp"
#include "figures/macro_regions_figure.hpp"
#include "figures/token_figure.hpp"
#include "figures/traffic.hpp"
#include "figures/traffic_figure.hpp"
#include "figures/well_formed.hpp"
#include "simulation/pictures.hpp"

namespace graycube::figures {
namespace {

using testing::xml_problem;

control::JobOptions as_in_1987() {
  control::JobOptions options;
  options.algorithm = Algorithm::kMacro;
  options.partition = PartitionMode::kRegular;
  options.shadows = ShadowMode::kForward;
  return options;
}

RunRecord run_of(const control::JobOptions& options, std::uint32_t nodes = 8) {
  RunRecord run = record_run(simulation::scene_text(48, 32), options, nodes);
  CHECK(run.outcome.violations.empty());
  return run;
}

TEST_CASE("the traffic drawn is what the nodes count as sent and received") {
  control::JobOptions blocking = as_in_1987();
  blocking.flow = FlowMode::kBlocking;
  blocking.queue = 1024;
  for (const control::JobOptions& options : {as_in_1987(), blocking}) {
    const RunRecord run = run_of(options);
    const auto links = traffic_of(run, 10);
    std::vector<std::uint64_t> sent(8);
    for (const LinkTraffic& link : links) {
      sent[link.from.value] += link.rays;
      CHECK(std::accumulate(link.over_time.begin(), link.over_time.end(), std::uint64_t{0}) ==
            link.rays);
      CHECK(Hypercube::of_size(8)->link_between(link.from, link.to));
    }
    const auto received = received_by(links, 8);
    REQUIRE(run.outcome.reports.size() == 8);
    std::uint64_t all = 0, forwarded = 0;
    for (const control::NodeStats& n : run.outcome.reports) {
      CHECK(sent[n.rank] == n.rays_out);
      CHECK(received[n.rank] == n.rays_in);
      all += sent[n.rank];
      forwarded += n.forwarded_shadow + n.forwarded_secondary;
    }
    CHECK(all > 100);
    CHECK(all == forwarded);
  }
}

TEST_CASE("the token's hops and rounds are the run's") {
  for (const std::uint32_t nodes : {2u, 8u, 16u}) {
    const RunRecord run = run_of(as_in_1987(), nodes);
    REQUIRE(run.outcome.done);
    const auto token = nlohmann::json::parse(run.outcome.done->stats.text)["token"];
    CHECK(run.token.size() == token["hops"]);
    const auto rounds = rounds_of(run);
    CHECK(rounds.size() == token["rounds"]);
    const Hypercube cube = *Hypercube::of_size(nodes);
    for (const TokenRound& r : rounds) CHECK(r.hops == nodes);
    for (const TokenHop& hop : run.token) {
      CHECK(hop.to == cube.ring_next(hop.from));
      CHECK(hop.arrived_s > hop.sent_s);
    }
    CHECK_FALSE(rounds.back().is_black);
    CHECK(xml_problem(token_svg("s.json", cube, run)).empty());
  }
}

TEST_CASE("a run is drawn the same each time, with an arrow for each link") {
  const Model model = compile_scene(*read_scene_text(simulation::scene_text(48, 32)).scene);
  const Picture picture{48, 32, std::vector<float>(48 * 32 * 3, 0.5f), {}, {}};
  const auto draw = [&] {
    return traffic_svg("s.json", picture, model.settings, *Hypercube::of_size(8),
                       run_of(as_in_1987()));
  };
  const std::string svg = draw();
  CHECK(xml_problem(svg).empty());
  CHECK(svg == draw());
  // An arrow's shaft is a curve; the legend has two. The picture's base64 has any letter.
  const std::string drawn =
      svg.substr(0, svg.find("<image")) + svg.substr(svg.find("<rect", svg.find("<image")));
  CHECK(testing::count(drawn, "Q") == traffic_of(run_of(as_in_1987()), 1).size() + 2);
}

TEST_CASE("boundaries are drawn where they are in the picture, and every region names its node") {
  const Hypercube cube = *Hypercube::of_size(8);
  const Picture picture{64, 64, std::vector<float>(64 * 64 * 3, 0.5f), {}, {}};
  const control::GridLayout grid{4, 2, 1, {-5, 20, 40}, {32}, {}};
  const std::string svg =
      macro_regions_svg("s.json", picture, cube, grid, PartitionMode::kBalanced);
  CHECK(xml_problem(svg).empty());
  // The edge at -5 is beside the picture; each of the others has a rim.
  CHECK(testing::count(svg, "stroke=\"#ffffff\" stroke-width=\"4\"") == 3);
  // Column 0 has no pixel, so that nodes 0 and 1 have no label.
  CHECK(testing::count(svg, ">0<") == 0);
  for (const char* rank : {">2<", ">3<", ">4<", ">5<", ">6<", ">7<"}) {
    CHECK(testing::count(svg, rank) == 1);
  }
  CHECK(pixels_between(grid.column_edges, 0, 64).from == 0);
  CHECK(pixels_between(grid.column_edges, 0, 64).to == 0);
  CHECK(pixels_between(grid.column_edges, 3, 64).to == 64);
}

}  // namespace
}  // namespace graycube::figures
