// The bytes that were sent between each two places of a farm, and how many of them cross from host
// to host with one placement of the nodes or another.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "simulation/machine.hpp"
#include "topology/host_placement.hpp"

namespace graycube::simulation {

class Traffic {
 public:
  explicit Traffic(std::uint32_t nodes) : nodes_(nodes), bytes_(std::size_t{nodes} * nodes, 0) {}

  void add(Place from, Place to, std::size_t bytes) {
    (from && to ? bytes_[std::size_t{from->value} * nodes_ + to->value] : with_frontal_) += bytes;
  }

  /// Bytes between nodes, without the frontal.
  std::uint64_t between_nodes() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t bytes : bytes_) sum += bytes;
    return sum;
  }
  /// Those of them whose nodes lie on different hosts.
  std::uint64_t between_hosts(const HostPlacement& placement) const {
    std::uint64_t sum = 0;
    for (std::uint32_t from = 0; from < nodes_; ++from) {
      for (std::uint32_t to = 0; to < nodes_; ++to) {
        if (placement.host_of(Rank{from}) != placement.host_of(Rank{to}))
          sum += bytes_[std::size_t{from} * nodes_ + to];
      }
    }
    return sum;
  }
  /// Bytes that the frontal sent or got.
  std::uint64_t with_frontal() const { return with_frontal_; }

 private:
  std::uint32_t nodes_;
  std::vector<std::uint64_t> bytes_;  // by sender × nodes + receiver
  std::uint64_t with_frontal_ = 0;
};

}  // namespace graycube::simulation
