// A node's brain, and the messages that it would get from the frontal and from neighbours, which
// aren't there.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "node/node.hpp"
#include "proto/control.hpp"

namespace graycube::testing {

/// The start number of every node.
inline constexpr std::uint32_t kIncarnation = 7;

/// The frontal's message for a job whose macro-regions have these boundaries: square tiles, a
/// window that holds them all, and no lack of credit.
inline control::Load load_of(control::GridLayout grid) {
  control::Load load;
  load.job = 1;
  load.grid = std::move(grid);
  load.tile_size = 16;
  load.link_credit_bytes = 1 << 20;
  load.window_tiles = 64;
  return load;
}

class NodeAtWork {
 public:
  /// The node of that rank, with all its neighbours there and ready to begin the job.
  NodeAtWork(const Hypercube& cube, Rank rank, const control::Load& load, const Bytes& slice)
      : node({rank, kIncarnation, 1, "ipc://here", 1, "test"}),
        cube_(cube),
        rank_(rank),
        sent_(cube.nodes(), 0) {
    tell(control::Welcome{cube.nodes(), "test",
                          std::vector<std::string>(cube.nodes(), "ipc://there"), 1000});
    for (std::uint32_t bit = 0; bit < cube.dimension(); ++bit) {
      const Rank peer = cube.neighbour(rank, bit);
      node.on_neighbour(
          encode_signal({0, 0, peer.value, kIncarnation, 0}, BatchType::kGreetingAck));
    }
    tell(load, slice);
    work();
    node.take_outgoing();
  }

  void begin() {
    tell(control::Start{1, 0, std::vector<std::uint32_t>(cube_.nodes(), kIncarnation)});
    node.take_outgoing();
  }

  Rank neighbour(std::uint32_t bit) const { return cube_.neighbour(rank_, bit); }
  /// The stamp of that neighbour's next batch.
  BatchStamp stamp_of(Rank sender) {
    return {1, 0, sender.value, kIncarnation, sent_[sender.value]++};
  }

  void tell(const ControlMessage& message, SharedBytes payload = {}) {
    node.on_frontal(Message::of_text(encode(message), std::move(payload)));
  }
  void assign(const std::vector<std::uint32_t>& tiles) {
    node.on_frontal(
        Message::of_batch(encode_assignment({1, 0, kFrontalRank, 0, assigned_++}, tiles)));
  }
  NodeAtWork(NodeAtWork&&) = default;

  /// Does one piece of work; false when there is none.
  bool work_once() {
    auto piece = node.take_work();
    if (!piece) return false;
    node.give_result(bench_.run(*std::move(piece)));
    return true;
  }
  /// Does all work that there is; returns the number of pieces.
  int work() {
    int pieces = 0;
    while (work_once()) ++pieces;
    return pieces;
  }

  Node node;

 private:
  Hypercube cube_;
  Rank rank_;
  std::vector<std::uint64_t> sent_;  // by sender
  std::uint64_t assigned_ = 0;
  Workbench bench_;
};

}  // namespace graycube::testing
