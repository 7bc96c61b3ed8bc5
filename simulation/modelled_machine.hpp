// A machine described by a few figures: the cost of each unit of work, the speed of links, the
// number of cores.
#pragma once

#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "simulation/machine.hpp"
#include "topology/host_placement.hpp"

namespace graycube::simulation {

/// CPU seconds of either end for each byte that CURVE ciphers (XSalsa20 with Poly1305 in
/// libsodium): between those measured with messages of 64 KiB and 8 KiB
/// (docs/lab/2026-12-01-hosts.md).
inline constexpr double kCipherByte_s = 0.85e-9;

struct MachineFigures {
  /// Bandwidth of each link in each direction, and of the frontal's one link to all nodes, in 10⁹
  /// bits a second. With hosts: of each host's network card, and of the frontal's, in each
  /// direction.
  double link_gbps = 10, host_gbps = 10;
  /// Microseconds from one end of a link to the other, beyond the time that the bytes take.
  double link_us = 50;
  /// Where the nodes lie; the frontal has a host of its own. Nothing: each node has one, with links
  /// of its own to its neighbours, and nothing is ciphered.
  std::optional<HostPlacement> placement{};
  /// The same as of links, between processes of one host.
  double local_gbps = 4.7, local_us = 20;
  /// Cores that all processes, or those of each host, share; 0 gives each process one of its own.
  unsigned cores = 0;
  /// Factor by which evaluators are slower than here; the brains' work on messages is not scaled.
  double cpu_scale = 1;
  /// CPU seconds of each unit of work here.
  PerUnit costs;
};

class ModelledMachine : public Machine {
 public:
  explicit ModelledMachine(const MachineFigures& figures)
      : figures_(figures), costs_(figures.costs), cards_(hosts()) {
    for (const Unit u : {Unit::kPiece, Unit::kRay, Unit::kVisit, Unit::kTest, Unit::kBuildByte}) {
      costs_[u] *= figures.cpu_scale;
    }
  }

  /// A link carries one message after another; all the frontal's messages share one link. Between
  /// processes of one node there is none.
  double arrival_s(Place from, Place to, std::size_t bytes, double now_s) override {
    if (from && from == to) return now_s;
    const bool is_host = !from || !to;
    if (figures_.placement && host_of(from) != host_of(to))
      return arrival_between_hosts_s(host_of(from), host_of(to), bytes, now_s);
    double& free_at_s = !from ? from_host_s_ : !to ? to_host_s_ : links_[{from->value, to->value}];
    const bool is_local = figures_.placement.has_value();
    const double gbps = is_local  ? figures_.local_gbps
                        : is_host ? figures_.host_gbps
                                  : figures_.link_gbps;
    free_at_s = std::max(free_at_s, now_s) + seconds_of(bytes, gbps);
    return free_at_s + 1e-6 * (is_local ? figures_.local_us : figures_.link_us);
  }
  double cpu_s(Place, const PerUnit& doings) override { return cost_of(doings, costs_); }
  unsigned own_cores() const override { return 1; }
  unsigned shared_cores() const override { return figures_.cores; }
  std::uint32_t hosts() const override {
    return figures_.placement ? figures_.placement->hosts() + 1 : 1;
  }
  std::uint32_t host_of(Place place) const override {
    if (!figures_.placement) return 0;
    return place ? figures_.placement->host_of(*place) : figures_.placement->hosts();
  }

 private:
  /// When a network card is free again, in each direction.
  struct Card {
    double out_s = 0, in_s = 0;
  };

  static double seconds_of(std::size_t bytes, double gbps) {
    return 8e-9 * static_cast<double>(bytes) / gbps;
  }
  double card_gbps(std::uint32_t host) const {
    return host + 1 == hosts() ? figures_.host_gbps : figures_.link_gbps;
  }
  /// The message leaves by one card and comes in by another, while it leaves: each carries one
  /// after another.
  double arrival_between_hosts_s(std::uint32_t from, std::uint32_t to, std::size_t bytes,
                                 double now_s) {
    const double begin_out_s = std::max(cards_[from].out_s, now_s);
    cards_[from].out_s = begin_out_s + seconds_of(bytes, card_gbps(from));
    const double begin_in_s = std::max(cards_[to].in_s, begin_out_s);
    cards_[to].in_s = std::max(cards_[from].out_s, begin_in_s + seconds_of(bytes, card_gbps(to)));
    return cards_[to].in_s + 1e-6 * figures_.link_us;
  }

  MachineFigures figures_;
  PerUnit costs_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> links_;
  double from_host_s_ = 0, to_host_s_ = 0;
  std::vector<Card> cards_;  // by host
};

}  // namespace graycube::simulation
