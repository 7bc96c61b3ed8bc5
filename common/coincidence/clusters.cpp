#include "coincidence/clusters.hpp"

#include <numeric>

namespace graycube::csg {

/// Joins pieces in a tree, over the gaps between the extents' middles, the smallest gap first. A
/// piece without a common point never gets one from what is joined to it.
ChainCutter::ChainCutter(std::span<Extent> chain) : chain_(chain) {
  const auto middle = [](const Extent& e) { return 0.5 * e.lo + 0.5 * e.hi; };
  // The result depends on order alone: of equal middles the better known comes first.
  std::sort(chain.begin(), chain.end(), [&](const Extent& a, const Extent& b) {
    const double m = middle(a), n = middle(b);
    return m != n ? m < n : a.lo != b.lo ? a.lo > b.lo : a.item < b.item;
  });
  std::vector<std::size_t> gaps(chain.size() - 1);
  std::iota(gaps.begin(), gaps.end(), std::size_t{0});
  const auto width = [&](std::size_t gap) { return middle(chain[gap + 1]) - middle(chain[gap]); };
  std::sort(gaps.begin(), gaps.end(), [&](std::size_t a, std::size_t b) {
    const double v = width(a), w = width(b);
    return v != w ? v < w : a < b;
  });
  for (std::size_t i = 0; i < chain.size(); ++i) {
    pieces_.push_back({i, i + 1, chain[i].lo, chain[i].hi, true});
    piece_of_.push_back(i);
  }
  for (const std::size_t gap : gaps) join(gap);
  keep(pieces_[piece_of_.front()]);
  std::sort(runs_.begin(), runs_.end(),
            [](const auto& a, const auto& b) { return a.data() < b.data(); });
}

/// Joins the pieces on both sides of a gap.
void ChainCutter::join(std::size_t gap) {
  Piece& before = pieces_[piece_of_[gap]];
  const Piece& behind = pieces_[piece_of_[gap + 1]];
  Piece both{before.first, behind.end, std::max(before.most_lo, behind.most_lo),
             std::min(before.least_hi, behind.least_hi), false};
  both.is_run = before.is_run && behind.is_run && both.most_lo <= both.least_hi;
  if (!both.is_run) {
    keep(before);
    keep(behind);
  }
  before = both;
  piece_of_[both.first] = piece_of_[both.end - 1] = piece_of_[gap];
}

void ChainCutter::keep(const Piece& piece) {
  if (piece.is_run) runs_.push_back(chain_.subspan(piece.first, piece.end - piece.first));
}

}  // namespace graycube::csg
