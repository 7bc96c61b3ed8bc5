// Contributions waiting to go to the frontal: those to one pixel are merged, credit is summed per tile.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "proto/batch.hpp"
#include "trace/contribution.hpp"
#include "trace/step.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {

class MergeBuffer {
 public:
  /// So many pixels are gathered before they are sent.
  static constexpr std::size_t kFullPixels = 8192;
  static_assert(contribution_batch_bytes(kFullPixels, kFullPixels) < kMaxContributionBatchBytes);

  MergeBuffer();

  /// Takes in returns until it is full or there are no more; says how many it took.
  std::size_t add(std::span<const PixelReturn> returns, const TilePlan& plan);
  /// The same for what came of a tile's primary rays, in which hardly a pixel comes twice: quicker, and what
  /// follows of a pixel by other ways is sent beside it.
  std::size_t add_tile(std::span<const PixelReturn> returns, std::uint32_t tile, const TilePlan& plan);
  bool is_empty() const { return merged_.credits.empty() && merged_.contributions.empty(); }
  bool is_full() const {
    return merged_.contributions.size() == kFullPixels || merged_.credits.size() == kFullPixels;
  }
  void clear();

  struct Merged {
    std::vector<TileCredit> credits;
    std::vector<Contribution> contributions;
  };
  /// Takes all; credits are exactly those of the light beside them.
  Merged take();

 private:
  /// Where a pixel or tile stands among those gathered; open addressing, at most half full.
  class Index {
   public:
    /// The place of `key`, which is `next` when it is new.
    std::uint32_t& place_of(std::uint32_t key, std::uint32_t next);
    void clear();

   private:
    static constexpr std::size_t kSlots = 2 * kFullPixels;
    struct Slot {
      std::uint32_t key = 0, place = 0, generation = 0;
    };
    std::vector<Slot> slots_ = std::vector<Slot>(kSlots);
    std::uint32_t generation_ = 1;
  };

  void add_credit(std::uint32_t tile, const Credit& credit);
  void add_light(const PixelReturn& r);

  Merged merged_;
  /// How many contributions each entry holds already.
  std::vector<std::uint32_t> in_entry_;
  Index pixels_, tiles_;
};

}  // namespace graycube
