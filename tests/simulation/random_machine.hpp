// A machine whose links and evaluators take random times, drawn from a seed alone.
#pragma once

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>

#include "simulation/farm.hpp"

namespace graycube::simulation {

struct RandomTimes {
  std::uint64_t seed = 1;
  /// Delays are drawn up to these; some links and evaluators are much slower than others.
  double link_delay_s = 1e-3;
  double work_s = 1e-3;
};

class RandomMachine : public Machine {
 public:
  explicit RandomMachine(const RandomTimes& times) : times_(times), random_(times.seed) {}

  void on_start(Rank rank) override { slowness_[rank] = random(1) < 0.2 ? 20 : 1; }
  double arrival_s(Place from, Place to, std::size_t, double now_s) override {
    // One link in ten is a hundred times slower than the rest.
    const auto [link, is_new] = links_.try_emplace({from, to}, Link{});
    Link& l = link->second;
    if (is_new && random(1) < 0.1) l.slowness = 100;
    l.last_s = std::max(l.last_s, now_s + random(times_.link_delay_s) * l.slowness);
    return l.last_s;
  }
  double cpu_s(Place at, const PerUnit& doings) override {
    if (!at || doings[Unit::kPiece] + doings[Unit::kBuildByte] == 0) return 0;
    return random(times_.work_s) * slowness_[*at];
  }

 private:
  double random(double most) { return std::uniform_real_distribution<double>(0, most)(random_); }

  struct Link {
    double last_s = 0, slowness = 1;
  };
  RandomTimes times_;
  std::mt19937_64 random_;
  std::map<std::pair<Place, Place>, Link> links_;
  std::map<Rank, double> slowness_;
};

/// The options of a test's farm.
struct RandomFarmOptions {
  std::uint32_t nodes = 8, threads = 1;
  std::uint64_t seed = 1;
  double link_delay_s = 1e-3;
  double heartbeat_s = 1, stalled_s = 600;
  FlowLimits limits{};
  std::uint64_t replica_bytes = kReplicaBytes;
  double silence_s = 1e12;
  std::uint32_t retries = kDefaultRetries;
};

class RandomFarm : private RandomMachine, public Farm {
 public:
  explicit RandomFarm(const RandomFarmOptions& o)
      : RandomMachine({.seed = o.seed, .link_delay_s = o.link_delay_s}),
        Farm({.nodes = o.nodes,
              .threads = o.threads,
              .heartbeat_s = o.heartbeat_s,
              .silence_s = o.silence_s,
              .retries = o.retries,
              .stalled_s = o.stalled_s,
              .limits = o.limits,
              .replica_bytes = o.replica_bytes},
             static_cast<RandomMachine&>(*this)) {}
};

}  // namespace graycube::simulation
