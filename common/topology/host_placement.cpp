#include "topology/host_placement.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>

#include "check.hpp"

namespace graycube {

namespace {

std::uint64_t sum_of(std::span<const std::uint32_t> slots) {
  return std::accumulate(slots.begin(), slots.end(), std::uint64_t{0});
}

/// How many nodes each host gets, one after another where a slot will have least to do.
std::vector<std::uint32_t> nodes_by_host(std::uint32_t nodes,
                                         std::span<const std::uint32_t> slots) {
  std::vector<std::uint32_t> held(slots.size(), 0);
  const auto is_better = [&](std::size_t a, std::size_t b) {
    if (held[a] == slots[a] || held[b] == slots[b]) return held[a] < slots[a];
    return std::uint64_t{held[a] + 1} * slots[b] < std::uint64_t{held[b] + 1} * slots[a];
  };
  for (std::uint32_t n = 0; n < nodes; ++n) {
    std::size_t best = 0;
    for (std::size_t host = 1; host < slots.size(); ++host) {
      if (is_better(host, best)) best = host;
    }
    ++held[best];
  }
  return held;
}

}  // namespace

std::optional<HostPlacement> HostPlacement::of(std::uint32_t nodes,
                                               std::span<const std::uint32_t> slots) {
  if (slots.empty() || slots.size() > kMaxHosts || nodes > kMaxNodes || sum_of(slots) < nodes)
    return std::nullopt;
  const std::vector<std::uint32_t> held = nodes_by_host(nodes, slots);
  std::vector<std::uint32_t> order(slots.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::ranges::greater{}, [&](std::uint32_t h) { return held[h]; });
  std::vector<std::uint32_t> host_by_rank;
  host_by_rank.reserve(nodes);
  for (const std::uint32_t host : order) host_by_rank.insert(host_by_rank.end(), held[host], host);
  return HostPlacement(static_cast<std::uint32_t>(slots.size()), std::move(host_by_rank));
}

HostPlacement HostPlacement::even(std::uint32_t nodes, std::uint32_t hosts) {
  GRAYCUBE_CHECK(hosts >= 1 && hosts <= nodes, "%u nodes on %u hosts", nodes, hosts);
  return *of(nodes, std::vector<std::uint32_t>(hosts, (nodes + hosts - 1) / hosts));
}

HostPlacement::HostPlacement(std::uint32_t hosts, std::vector<std::uint32_t> host_by_rank)
    : hosts_(hosts), host_by_rank_(std::move(host_by_rank)) {
  for (const std::uint32_t host : host_by_rank_)
    GRAYCUBE_CHECK(host < hosts_, "host %u of %u", host, hosts_);
}

std::uint32_t most_nodes(std::span<const std::uint32_t> slots) {
  return static_cast<std::uint32_t>(
      std::bit_floor(std::min<std::uint64_t>(sum_of(slots), kMaxNodes)));
}

}  // namespace graycube
