// Which hosts the nodes lie on: consecutive ranks together, since these are neighbours in the grid
// of macro-regions (hilbert.hpp) and send each other most rays.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "topology/hypercube.hpp"

namespace graycube {

inline constexpr std::uint32_t kMaxHosts = kMaxNodes;

class HostPlacement {
 public:
  /// Deals out nodes so that no host has many more for each of its slots (cores, say) than another.
  /// The host with most nodes gets the lowest ranks: with powers of two, all hosts are subcubes.
  /// Nothing if there are no hosts or more than kMaxHosts, or fewer slots than nodes.
  static std::optional<HostPlacement> of(std::uint32_t nodes, std::span<const std::uint32_t> slots);
  /// The same for hosts that are all alike: their nodes differ by one at most. 1 ≤ `hosts` ≤
  /// `nodes`.
  static HostPlacement even(std::uint32_t nodes, std::uint32_t hosts);

  /// Any placement; each entry is below `hosts`.
  HostPlacement(std::uint32_t hosts, std::vector<std::uint32_t> host_by_rank);

  std::uint32_t hosts() const { return hosts_; }
  std::uint32_t nodes() const { return static_cast<std::uint32_t>(host_by_rank_.size()); }
  std::uint32_t host_of(Rank rank) const { return host_by_rank_[rank.value]; }

 private:
  std::uint32_t hosts_;
  std::vector<std::uint32_t> host_by_rank_;
};

/// The most nodes that a farm on hosts with so many slots has: a power of two, kMaxNodes at most;
/// 0 if there is no slot.
std::uint32_t most_nodes(std::span<const std::uint32_t> slots);

}  // namespace graycube
