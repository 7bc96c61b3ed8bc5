// Counts which nodes have answered, each once.
#pragma once

#include <cstdint>
#include <vector>

#include "topology/rank.hpp"

namespace graycube {

class RollCall {
 public:
  explicit RollCall(std::uint32_t nodes) : has_answered_(nodes, false) {}

  /// False if the node had answered before.
  bool note(Rank rank) {
    if (has_answered_[rank.value]) return false;
    has_answered_[rank.value] = true;
    ++count_;
    return true;
  }
  bool is_complete() const { return count_ == has_answered_.size(); }

 private:
  std::vector<bool> has_answered_;  // by rank
  std::size_t count_ = 0;
};

}  // namespace graycube
