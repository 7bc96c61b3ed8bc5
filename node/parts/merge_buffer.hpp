// Contributions waiting to go to the frontal, or to the parent in the tree of sums: those to one
// pixel are merged, credit is summed per tile.
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
  /// Pixels or tiles that are gathered before they are sent.
  static constexpr std::size_t kFullPixels = 8192;
  /// The same where other nodes' light comes too: the longer it waits, the more of it is merged.
  static constexpr std::size_t kFullOfOthers = 32768;
  /// The most pixels in a buffer for other nodes' light, and so in a batch between nodes.
  static constexpr std::size_t kMostPixels = 2 * kFullOfOthers;
  static_assert(most_contribution_bytes(kMostPixels, kMostPixels) < kMaxContributionBatchBytes);

  MergeBuffer();
  /// Empties the buffer, and makes room for other nodes' light or gives that room up.
  void expect_others(bool others);

  /// Takes in returns until it is full or there are no more; says how many it took.
  std::size_t add(std::span<const PixelReturn> returns, const TilePlan& plan);
  /// The same for the returns of a tile's primary rays, in which hardly any pixel comes twice. It
  /// is quicker, but light that reaches a pixel in other ways is not merged with it.
  std::size_t add_tile(std::span<const PixelReturn> returns, std::uint32_t tile,
                       const TilePlan& plan);
  /// Takes in what another node has gathered: all of it, or nothing and false when that doesn't fit
  /// beside what is here already.
  [[nodiscard]] bool add_gathered(std::span<const TileCredit> credits,
                                  std::span<const Contribution> contributions);
  bool is_empty() const { return merged_.credits.empty() && merged_.contributions.empty(); }
  bool is_full() const {
    return merged_.contributions.size() >= full_ || merged_.credits.size() >= full_;
  }
  struct Merged {
    std::vector<TileCredit> credits;
    std::vector<Contribution> contributions;
  };
  /// All that is gathered here; the credits are exactly those of the light beside them.
  const Merged& gathered() const { return merged_; }
  /// Forgets what is gathered; the memory serves what comes next.
  void clear();

 private:
  /// Maps a pixel or tile to its place among those gathered; open addressing, at most half full.
  class Index {
   public:
    /// The place of `key`; a new key is entered with the place `next`.
    std::uint32_t& place_of(std::uint32_t key, std::uint32_t next);
    void clear();

   private:
    struct Slot {
      std::uint32_t key = 0, place = 0, generation = 0;
    };
    /// Slots at first, a power of two. Most nodes look few pixels up: where tiles come whole, none.
    static constexpr std::size_t kFewSlots = 512;

    Slot& slot_of(std::uint32_t key);
    void grow();

    std::vector<Slot> slots_;
    std::size_t count_ = 0;
    std::uint32_t generation_ = 1;
  };

  void make_room();
  void add_credit(std::uint32_t tile, const Credit& credit);
  void add_light(std::uint32_t pixel, const FixedRgb& light);

  Merged merged_;
  std::size_t full_ = kFullPixels, most_ = kFullPixels;
  Index pixels_, tiles_;
};

}  // namespace graycube
