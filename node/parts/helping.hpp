// Neighbours that help each other: a node that has nothing to do says so, and gets tiles and rays
// from a neighbour that has much to do, to trace them in a copy of its regions.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "node/parts/mail.hpp"
#include "trace/domain.hpp"

namespace graycube {

class Helping {
 public:
  struct Rules {
    /// False where nobody helps.
    bool is_on = false;
    /// Bytes of this node's slice of the scene.
    std::size_t slice_bytes = 0;
  };
  /// Most tiles that are given away at a time.
  static constexpr std::size_t kMostTiles = 16;
  /// The work that waits on this node.
  struct Supply {
    /// Tiles to be begun; how many at their end are own ones, up to kMostTiles; and tiles that the
    /// frontal has not handed out yet.
    std::size_t tiles = 0, own_tiles_at_end = 0;
    std::uint64_t unassigned_tiles = 0;
    std::size_t rays = 0;
  };
  /// What a neighbour is to get: a copy of this node's slice, or at most `most` tiles or rays.
  struct Gift {
    enum class Kind : std::uint8_t { kNothing, kCopy, kTiles, kRays } kind = Kind::kNothing;
    std::size_t most = 0;
  };

  Helping(std::uint32_t links, const Rules& rules) : rules_(rules), neighbours_(links) {}
  bool is_on() const { return rules_.is_on; }

  // The helper
  /// Tells the neighbours that there is nothing to do here, each once until it has sent something.
  void offer(Mail& mail);
  /// The neighbour across that bit has sent something to do.
  void has_given(std::uint32_t bit) { neighbours_[bit].was_told = false; }
  /// A copy of the neighbour's regions is here.
  void adopt(std::uint32_t bit, std::shared_ptr<const Domain> copy);
  /// The copy of the neighbour's regions; null if there is none, or no such link.
  std::shared_ptr<const Domain> copy_of(std::uint32_t bit) const;
  void took_over(std::uint64_t tiles, std::uint64_t rays);

  // The node that is helped
  /// A neighbour without tiles may begin, and be idle, before this node has heard that the picture
  /// begins: its offer waits. False when the batch is broken.
  [[nodiscard]] bool on_offer(std::uint32_t bit, std::span<const std::byte> batch, BatchType type,
                              const BatchLimits& limits, Mail& mail);
  bool has_offer(std::uint32_t bit) const { return neighbours_[bit].offer != Offer::kNone; }
  /// Counts work done here, in tests of a primitive; it was for a tile, or for rays.
  void has_traced(double work, bool is_tile);
  /// What the neighbour across that bit gets now, at most `most_rays` rays. It counts as given.
  Gift gift_for(std::uint32_t bit, const Supply& supply, std::size_t most_rays);

  void report(control::NodeStats& stats) const;
  /// A new epoch; copies stay.
  void reset();

 private:
  enum class Offer : std::uint8_t { kNone, kIdle, kIdleWithCopy };
  struct Neighbour {
    /// Whether the neighbour was told that this node has nothing to do.
    bool was_told = false;
    /// The neighbour's offer to help, until it gets something; and the work that it had done by
    /// then, in tests of a primitive.
    Offer offer = Offer::kNone;
    std::uint64_t offered_after = 0;
    /// The frontal was asked to give it a copy of this node's slice.
    bool was_recommended = false;
    std::shared_ptr<const Domain> copy;
  };
  struct Taken {
    std::uint64_t copies = 0, tiles = 0, rays = 0;
  };

  double work_of_a_tile() const;
  double work_to_spare(const Neighbour& neighbour, const Supply& supply) const;
  bool copy_pays(const Neighbour& neighbour, const Supply& supply) const;
  Gift gift_of(const Neighbour& neighbour, const Supply& supply, std::size_t most_rays) const;

  Rules rules_;
  std::vector<Neighbour> neighbours_;  // by bit
  /// The work done here in this epoch, in tests of a primitive; and how many tiles that included.
  double work_done_ = 0;
  std::uint64_t tiles_traced_ = 0;
  Taken taken_;
};

}  // namespace graycube
