// Nodes on hosts: what crosses from host to host, and how the machine carries it.
// GRAYCUBE_SCENE=FILE simulation_tests "[measure]" prints the bytes between hosts for a scene file.
#include <algorithm>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <random>

#include "catch.hpp"
#include "simulation/message_doings.hpp"
#include "simulation/modelled_machine.hpp"
#include "simulation/pictures.hpp"
#include "simulation/traffic.hpp"

using namespace graycube;
using namespace graycube::simulation;

namespace {

constexpr std::uint32_t kNodes = 64, kHosts = 8;

MachineFigures figures_on(std::optional<HostPlacement> placement) {
  MachineFigures figures;
  figures.placement = std::move(placement);
  for (double& cost : figures.costs.value) cost = 1e-7;
  figures.costs[Unit::kMessageByte] = figures.costs[Unit::kLightByte] = 1e-9;
  figures.costs[Unit::kFrontalByte] = figures.costs[Unit::kBuildByte] = 1e-9;
  figures.costs[Unit::kCipherByte] = kCipherByte_s;
  return figures;
}

HostPlacement dealt_at_random(std::uint32_t nodes, std::uint32_t hosts, unsigned seed) {
  std::vector<std::uint32_t> host_by_rank(nodes);
  for (std::uint32_t r = 0; r < nodes; ++r) host_by_rank[r] = r % hosts;
  std::ranges::shuffle(host_by_rank, std::mt19937(seed));
  return {hosts, host_by_rank};
}

/// Ranks as they were before they followed Hilbert's curve: row by row of the grid.
HostPlacement in_rows(std::uint32_t nodes, std::uint32_t hosts) {
  const Hypercube cube = *Hypercube::of_size(nodes);
  std::vector<std::uint32_t> host_by_rank(nodes);
  for (Rank r; cube.has(r); ++r.value) {
    const std::uint32_t place = cube.row_of(r) * cube.columns() + cube.column_of(r);
    host_by_rank[r.value] = place * hosts / nodes;
  }
  return {hosts, host_by_rank};
}

/// Hosts that are the subcubes in which these bits of the label are the same: whichever there are.
HostPlacement by_label(std::uint32_t nodes, std::uint32_t fixed_bits) {
  const Hypercube cube = *Hypercube::of_size(nodes);
  std::vector<std::uint32_t> host_by_rank(nodes);
  for (Rank r; cube.has(r); ++r.value) {
    std::uint32_t host = 0;
    for (std::uint32_t bit = cube.dimension(); bit-- > 0;) {
      if ((fixed_bits >> bit & 1) != 0) host = host << 1 | (cube.label_of(r).value >> bit & 1);
    }
    host_by_rank[r.value] = host;
  }
  return {1u << static_cast<std::uint32_t>(std::popcount(fixed_bits)), host_by_rank};
}

Traffic traffic_of(const std::string& text, const control::JobOptions& options,
                   std::uint32_t nodes) {
  ModelledMachine machine(figures_on(HostPlacement::even(nodes, std::min(nodes, kHosts))));
  Farm farm({.nodes = nodes, .threads = 1, .stalled_s = 1e6}, machine);
  Traffic traffic(nodes);
  farm.on_sent = [&](Place from, Place to, double, const Message& m) {
    traffic.add(from, to, bytes_of(m));
  };
  const Outcome outcome = farm.render(text, options);
  CHECK(outcome.violations.empty());
  REQUIRE(outcome.done);
  return traffic;
}

double mean_at_random(const Traffic& traffic, std::uint32_t nodes, std::uint32_t hosts) {
  constexpr unsigned kSeeds = 10;
  double sum = 0;
  for (unsigned seed = 0; seed < kSeeds; ++seed)
    sum += static_cast<double>(traffic.between_hosts(dealt_at_random(nodes, hosts, seed)));
  return sum / kSeeds;
}

}  // namespace

TEST_CASE("64 nodes on 8 hosts send at most half of what crosses hosts when dealt at random") {
  const std::string text = scene_text(192, 192);
  for (const ShadowMode shadows : {ShadowMode::kHorizon, ShadowMode::kForward}) {
    control::JobOptions options = with(Algorithm::kMacro);
    options.shadows = shadows;
    const Traffic traffic = traffic_of(text, options, kNodes);
    const std::uint64_t placed = traffic.between_hosts(HostPlacement::even(kNodes, kHosts));
    CHECK(placed > 0);
    for (unsigned seed = 0; seed < 20; ++seed) {
      INFO("seed " << seed);
      CHECK(2 * placed <= traffic.between_hosts(dealt_at_random(kNodes, kHosts, seed)));
    }
  }
}

TEST_CASE("a picture doesn't show on which hosts nodes lie") {
  const std::string text = scene_text(48, 48);
  const Picture expected = serial_picture(text);
  for (const std::uint32_t hosts : {1u, 3u, 8u}) {
    MachineFigures figures = figures_on(HostPlacement::even(16, std::min(16u, hosts)));
    figures.cores = 2;
    ModelledMachine machine(figures);
    Farm farm({.nodes = 16, .threads = 1, .hosts = hosts}, machine);
    check_same_picture(farm, farm.render(text, with(Algorithm::kMacro)), 1, expected);
  }
}

TEST_CASE("a host's network card carries one message after another, in each direction") {
  MachineFigures figures;
  figures.placement = HostPlacement::even(4, 2);
  figures.link_gbps = 8;  // 1 ns a byte
  figures.host_gbps = 4;
  figures.link_us = 0;
  ModelledMachine machine(figures);
  const Rank a{0}, b{1}, c{2}, d{3};
  CHECK(machine.arrival_s(a, c, 1000, 0) == Approx(1e-6));
  CHECK(machine.arrival_s(b, d, 1000, 0) == Approx(2e-6));  // the same two cards
  CHECK(machine.arrival_s(c, a, 1000, 0) == Approx(1e-6));  // the other way
  CHECK(machine.arrival_s(a, {}, 1000, 0) ==
        Approx(4e-6));  // frees its own at 3, the frontal's at 4
  CHECK(machine.arrival_s({}, a, 1000, 0) == Approx(2e-6));  // out at 2, in after c's message
  CHECK(machine.arrival_s(d, {}, 1000, 0) == Approx(6e-6));  // the frontal's one card
}

TEST_CASE("nodes of one host send each other messages beside its network card, unciphered") {
  MachineFigures figures;
  figures.placement = HostPlacement::even(4, 2);
  figures.link_gbps = 1e-3;
  figures.local_gbps = 8;
  figures.local_us = 5;
  ModelledMachine machine(figures);
  CHECK(machine.arrival_s(Rank{0}, Rank{1}, 1000, 0) == Approx(6e-6));
  CHECK(machine.arrival_s(Rank{0}, Rank{2}, 1000, 0) > 1e-3);
  CHECK(machine.arrival_s(Rank{0}, Rank{1}, 1000, 0) == Approx(7e-6));
  CHECK(machine.hosts() == 3);
  CHECK(machine.host_of(Rank{0}) == machine.host_of(Rank{1}));
  CHECK(machine.host_of(Rank{1}) != machine.host_of(Rank{2}));
  CHECK(machine.host_of({}) == 2);
}

TEST_CASE("bytes between hosts take ciphering on both sides, those within a host none") {
  const std::string text = scene_text(64, 64);
  const auto cpu_s = [&](const HostPlacement& placement, double cipher_s) {
    MachineFigures figures = figures_on(placement);
    figures.costs[Unit::kCipherByte] = cipher_s;
    ModelledMachine machine(figures);
    Farm farm({.nodes = 8, .threads = 1}, machine);
    double sum = 0;
    for (const control::NodeStats& n : farm.render(text, with(Algorithm::kMacro)).reports)
      sum += n.cpu_s;
    return sum;
  };
  // On one host only what goes to and comes from the frontal is ciphered.
  const double one = cpu_s(HostPlacement::even(8, 1), 1e-6),
               more = cpu_s(HostPlacement::even(8, 4), 1e-6);
  CHECK(one > cpu_s(HostPlacement::even(8, 1), 0));
  CHECK(more > one);
}

TEST_CASE("with cores by host, nodes of other hosts hold nobody up") {
  const std::string text = scene_text(96, 96);
  const auto render_s = [&](std::uint32_t hosts) {
    MachineFigures figures = figures_on(HostPlacement::even(16, hosts));
    figures.cores = 1;
    ModelledMachine machine(figures);
    Farm farm({.nodes = 16, .threads = 1}, machine);
    return farm.render(text, with(Algorithm::kRoth)).render_s;
  };
  CHECK(render_s(8) < 0.5 * render_s(1));
}

TEST_CASE("bytes between hosts of a scene file", "[.measure]") {
  const char* file = std::getenv("GRAYCUBE_SCENE");
  if (file == nullptr) return;
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const char* side = std::getenv("GRAYCUBE_SIDE");
  control::JobOptions options = with(Algorithm::kMacro);
  options.width = options.height =
      side != nullptr ? static_cast<std::uint32_t>(std::strtoul(side, nullptr, 10)) : 256;
  if (const char* shadows = std::getenv("GRAYCUBE_FORWARD"); shadows != nullptr)
    options.shadows = ShadowMode::kForward;
  for (const auto& [nodes, hosts] : {std::pair{16u, 4u}, std::pair{64u, 8u}, std::pair{64u, 6u}}) {
    const Traffic traffic = traffic_of(text, options, nodes);
    const double random = mean_at_random(traffic, nodes, hosts);
    const auto share = [&](const HostPlacement& p) {
      return 100 * static_cast<double>(traffic.between_hosts(p)) / random;
    };
    std::printf(
        "%s %u nodes %u hosts: between nodes %.2f MB, with the frontal %.2f MB; between hosts "
        "at random %.2f MB, in rows %.0f %%, as placed %.0f %%",
        file, nodes, hosts, 1e-6 * static_cast<double>(traffic.between_nodes()),
        1e-6 * static_cast<double>(traffic.with_frontal()), 1e-6 * random,
        share(in_rows(nodes, hosts)), share(HostPlacement::even(nodes, hosts)));
    if (std::has_single_bit(hosts)) {
      double best = 1e9, worst = 0;
      std::uint32_t best_bits = 0;
      for (std::uint32_t bits = 0; bits < nodes; ++bits) {
        if (1u << std::popcount(bits) != hosts) continue;
        const double s = share(by_label(nodes, bits));
        worst = std::max(worst, s);
        if (s < best) best = s, best_bits = bits;
      }
      std::printf(", best subcubes %.0f %% (label bits between hosts %x), worst %.0f %%", best,
                  best_bits, worst);
    }
    std::printf("; bytes by label bit, kB:");
    const Hypercube cube = *Hypercube::of_size(nodes);
    for (std::uint32_t bit = 0; bit < cube.dimension(); ++bit)
      std::printf(" %.0f",
                  1e-3 * static_cast<double>(traffic.between_hosts(by_label(nodes, 1u << bit))));
    std::printf("\n");
  }
}
