// Closed outlines of cubic Bézier segments in a plane, the same for all who use a copy: lines are
// taken to their pieces, each monotonic in x and in y, through a hierarchy of boxes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "outline/pieces.hpp"

namespace graycube {

/// The most segments of one outline.
inline constexpr std::uint32_t kMaxOutlineSegments = 4096;

/// A point is inside if an odd number of loops goes round it.
class Outline {
 public:
  /// The empty outline.
  Outline();
  /// Each loop has three finite points a segment (pieces.hpp).
  explicit Outline(OutlineLoops loops);

  const OutlineLoops& loops() const;
  std::span<const OutlinePiece> pieces() const;
  std::size_t memory_bytes() const;

  bool contains(const OutlinePoint& p) const;
  /// False only if no piece has a point in the rectangle.
  bool may_touch(const OutlineBox& rectangle) const;

  /// Calls visit(piece) for the pieces in boxes for which meets(box) holds, in order.
  template <typename Meets, typename Visit>
  void each_piece(Meets&& meets, Visit&& visit) const {
    const Levels& all = levels();
    if (all.empty()) return;
    descend(all.size() - 1, 0, all.back().size(), meets, visit);
  }

  bool is_same_as(const Outline& other) const { return data_ == other.data_; }
  friend bool operator==(const Outline& a, const Outline& b) {
    return a.data_ == b.data_ || a.loops() == b.loops();
  }

 private:
  /// Box i of level 0 encloses piece i; of each other level, the boxes of the level below from
  /// kWidth · i on.
  using Levels = std::vector<std::vector<OutlineBox>>;
  static constexpr std::size_t kWidth = 8;
  struct Data;
  const Levels& levels() const;

  template <typename Meets, typename Visit>
  void descend(std::size_t level, std::size_t first, std::size_t last, Meets& meets,
               Visit& visit) const {
    for (std::size_t i = first; i < last; ++i) {
      if (!meets(levels()[level][i])) continue;
      if (level == 0) {
        visit(pieces()[i]);
        continue;
      }
      const std::size_t below = levels()[level - 1].size(), end = kWidth * (i + 1);
      descend(level - 1, kWidth * i, end < below ? end : below, meets, visit);
    }
  }

  std::shared_ptr<const Data> data_;
};

}  // namespace graycube
