// Tells from nodes' pongs which node is at the same pieces of work for too long, and whether all of
// them wait for something that never comes.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "proto/messages.hpp"
#include "topology/rank.hpp"

namespace graycube {

class StandstillWatch {
 public:
  explicit StandstillWatch(std::uint32_t nodes) : nodes_(nodes) {}

  /// Tracing begins, or something has come from a node: nobody has waited yet.
  void begin() { std::ranges::fill(nodes_, Node{}); }
  void on_pong(Rank rank, const control::Pong& pong, double now_s) {
    Node& node = nodes_[rank.value];
    if (node.has_answered && node.moves == pong.moves && node.working == pong.working) return;
    node = {true, pong.moves, pong.working, now_s};
  }

  /// A node that works, but hasn't finished a piece of work for so long.
  std::optional<Rank> standing_still(double now_s, double patience_s) const {
    for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) {
      const Node& node = nodes_[rank];
      if (node.working > 0 && now_s - node.since_s > patience_s) return Rank{rank};
    }
    return std::nullopt;
  }
  /// Whether no node has worked for so long.
  bool all_wait(double now_s, double patience_s) const {
    return std::ranges::all_of(nodes_, [&](const Node& node) {
      return node.has_answered && node.working == 0 && now_s - node.since_s > patience_s;
    });
  }

 private:
  struct Node {
    bool has_answered = false;
    /// As the node's last pong says, and since when it says so.
    std::uint64_t moves = 0, working = 0;
    double since_s = 0;
  };
  std::vector<Node> nodes_;  // by rank
};

}  // namespace graycube
