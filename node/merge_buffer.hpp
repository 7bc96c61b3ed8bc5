// Contributions waiting to go to the frontal: those to one pixel are merged, credit is summed per tile.
#pragma once

#include <vector>

#include "proto/batch.hpp"
#include "trace/contribution.hpp"
#include "trace/step.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {

class MergeBuffer {
 public:
  /// So many returns are gathered before they are merged and sent.
  static constexpr std::size_t kFullReturns = 8192;
  static_assert(contribution_batch_bytes(kFullReturns, kFullReturns) < kMaxContributionBatchBytes);

  void add(const std::vector<PixelReturn>& returns) {
    returns_.insert(returns_.end(), returns.begin(), returns.end());
  }
  bool is_empty() const { return returns_.empty(); }
  bool is_full() const { return returns_.size() >= kFullReturns; }
  void clear() { returns_.clear(); }

  struct Merged {
    std::vector<TileCredit> credits;
    std::vector<Contribution> contributions;
  };
  /// Takes the first kFullReturns returns or fewer; credits are exactly those of the light beside them.
  Merged take(const TilePlan& plan);

 private:
  std::vector<PixelReturn> returns_;
};

}  // namespace graycube
