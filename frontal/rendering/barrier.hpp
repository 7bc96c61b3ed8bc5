// Which nodes can trace: each must have got and subdivided its slice, and, when an epoch begins
// while the job is on, have dropped what is older (docs/design/epochs.md).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "topology/rank.hpp"

namespace graycube {

class Barrier {
 public:
  /// `waits_for_all`: no node may trace before all can. Otherwise a node that is replaced joins the
  /// others later.
  Barrier(std::uint32_t nodes, bool waits_for_all)
      : waits_for_all_(waits_for_all), nodes_(nodes), to_load_(nodes) {}

  void begin(std::uint32_t epoch) {
    epoch_ = epoch;
    for (Node& node : nodes_) node.has_acknowledged = false;
  }
  /// All nodes need their slices anew.
  void load_all() {
    std::ranges::fill(nodes_, Node{});
    to_load_ = nodes_.size();
    loaded_in_ = epoch_;
  }
  /// The node is lost: another process needs its slice.
  void lose(Rank rank) {
    to_load_ += nodes_[rank.value].is_loaded ? 1 : 0;
    nodes_[rank.value] = {};
  }
  bool needs_load(Rank rank) const { return !nodes_[rank.value].is_loaded; }
  bool needs_load() const { return to_load_ > 0; }
  void was_loaded(Rank rank) {
    to_load_ -= nodes_[rank.value].is_loaded ? 0 : 1;
    nodes_[rank.value].is_loaded = true;
  }

  /// The node says, in that epoch, that its slice is subdivided.
  void is_ready(Rank rank, std::uint32_t epoch) {
    Node& node = nodes_[rank.value];
    if (!node.is_loaded || epoch < loaded_in_ || epoch > epoch_) return;
    node.has_built = true;
    node.has_acknowledged = node.has_acknowledged || epoch == epoch_;
  }
  void has_acknowledged(Rank rank, std::uint32_t epoch) {
    if (epoch == epoch_) nodes_[rank.value].has_acknowledged = true;
  }
  /// Whether the node has its slice and not subdivided it yet.
  bool is_building(Rank rank) const {
    return nodes_[rank.value].is_loaded && !nodes_[rank.value].has_built;
  }
  bool can_trace(Rank rank) const {
    return nodes_[rank.value].has_built && nodes_[rank.value].has_acknowledged;
  }
  /// Whether tracing may begin.
  bool is_open() const {
    const auto waits = [](const Node& n) { return n.has_built && !n.has_acknowledged; };
    if (waits_for_all_ || epoch_ == 0)
      return std::ranges::all_of(nodes_, [](const Node& n) { return n.has_built; }) &&
             std::ranges::none_of(nodes_, waits);
    return std::ranges::any_of(nodes_, &Node::has_built) && std::ranges::none_of(nodes_, waits);
  }

 private:
  struct Node {
    bool is_loaded = false, has_built = false, has_acknowledged = false;
  };
  bool waits_for_all_;
  std::uint32_t epoch_ = 0;
  /// The epoch in which all nodes were loaded last.
  std::uint32_t loaded_in_ = 0;
  std::vector<Node> nodes_;  // by rank
  /// Nodes that need their slices.
  std::size_t to_load_;
};

}  // namespace graycube
