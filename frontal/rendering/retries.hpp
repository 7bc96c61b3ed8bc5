// How often each tile was under way when something was lost, and each node lost before it could
// trace: a tile or slice that brings one process after another down must not do so for ever.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "proto/messages.hpp"
#include "topology/rank.hpp"

namespace graycube {

class Retries {
 public:
  Retries(std::uint32_t most, std::uint32_t nodes) : most_(most), in_a_row_(nodes, 0) {}

  /// Something was lost while these tiles, of `tiles` in all, were under way. Returns one of them
  /// if that has happened to it too often.
  std::optional<std::uint32_t> note_loss(std::span<const std::uint32_t> under_way,
                                         std::uint32_t tiles) {
    if (losses_.empty()) losses_.resize(tiles);
    for (const std::uint32_t tile : under_way) ++losses_[tile];
    const auto beyond = std::ranges::find_if(
        under_way, [this](std::uint32_t tile) { return losses_[tile] > most_; });
    if (beyond == under_way.end()) return std::nullopt;
    return *beyond;
  }
  /// Losses at which the tile was under way.
  std::uint32_t losses_of(std::uint32_t tile) const { return losses_.empty() ? 0 : losses_[tile]; }

  /// The node was lost before its slice was subdivided. True if that has happened too often in a
  /// row.
  [[nodiscard]] bool note_loss_before_it_could_trace(Rank rank) {
    return ++in_a_row_[rank.value] > most_;
  }
  void can_trace(Rank rank) { in_a_row_[rank.value] = 0; }

 private:
  std::uint32_t most_;
  std::vector<std::uint8_t> losses_;     // by tile; empty before the first loss
  std::vector<std::uint32_t> in_a_row_;  // by rank
};

}  // namespace graycube
