// Work that waits on a node: models to subdivide, rays, and primary rays of tiles; and the choice
// of what is done next.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "node/parts/pace.hpp"
#include "node/parts/ray_store.hpp"
#include "node/work.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {

class WorkQueue {
 public:
  using ModelWork = std::variant<BorrowWork, CopyWork, SlideWork>;
  struct Piece {
    std::variant<TileWork, RayWork> what;
    /// The neighbour in whose regions the rays are to be traced; nothing for own regions and tiles.
    std::optional<Rank> helped;
    /// The rays came across links, and so much credit may now be free that it is worth a message.
    bool is_received = false;
  };

  /// `own_tiles`: how many tiles the frontal will hand out to this node, where that is known.
  WorkQueue(std::uint64_t own_tiles, bool is_one_by_one);

  void add_model(ModelWork model) { models_.push_back(std::move(model)); }
  bool has_models() const { return !models_.empty(); }
  /// The model that has waited longest; nothing if none waits.
  std::optional<ModelWork> take_model();

  void add_tiles(std::span<const std::uint32_t> tiles) {
    tiles_.insert(tiles_.end(), tiles.begin(), tiles.end());
  }
  /// So many own tiles will not be handed out any more: they have been, or others traced them.
  void expect_less(std::uint64_t own_tiles) { unassigned_ -= std::min(unassigned_, own_tiles); }
  /// Own tiles that the frontal has not handed out yet.
  std::uint64_t unassigned() const { return unassigned_; }
  std::size_t tiles() const { return tiles_.size(); }
  bool has_tiles() const { return !tiles_.empty() || open_; }
  /// How many of the last tiles, up to `most`, are own ones without a gap: `is_own(tile)` holds.
  template <typename IsOwn>
  std::size_t own_tiles_at_end(std::size_t most, IsOwn&& is_own) const;
  /// Takes the last `count` tiles, last first: this node itself begins tiles from the other end.
  std::vector<std::uint32_t> give_tiles(std::size_t count);

  /// Rays in this node's regions that came across a link, whose credit they take up until they are
  /// taken.
  void add_received(std::span<const RayTask> rays, std::uint32_t bit) { received_.add(rays, bit); }
  /// Other rays in this node's regions: they were created here, or set aside by a piece of work.
  void add_own(std::span<const RayTask> rays) { own_.add(rays, 0); }
  /// Rays in the regions of the neighbour `owner`, which came from there across `bit`.
  void add_helped(Rank owner, std::uint32_t bit, std::span<const RayTask> rays);
  /// The same for rays that a piece of work set aside: they go to the front of the queue.
  void add_helped_again(Rank owner, std::vector<RayTask> rays);
  bool has_rays() const { return !received_.is_empty() || !own_.is_empty() || !helped_.empty(); }
  std::size_t received() const { return received_.size(); }
  /// Rays that came across links, those for a neighbour's regions included.
  std::size_t held() const;
  /// Takes up to `most` of the deepest received rays; `taken_from(bit, count)` frees their credit.
  template <typename TakenFrom>
  std::vector<RayTask> give_rays(std::size_t most, TakenFrom&& taken_from) {
    return received_.take(most, taken_from);
  }

  /// The next piece of work, models aside: rays first, then tiles if `may_start_tiles`.
  template <typename TakenFrom>
  std::optional<Piece> take(const Pace& pace, bool may_start_tiles, const TilePlan& plan,
                            TakenFrom&& taken_from);

  /// Neither rays nor tiles are left, and the frontal has no more tiles for this node.
  bool is_empty() const { return !has_rays() && !has_tiles() && unassigned_ == 0; }
  /// A new epoch: of what waits only copies of neighbours' slices stay.
  void reset();
  /// The epoch leaves so many of this node's own tiles to be traced.
  void expect_only(std::uint64_t own_tiles) { unassigned_ = own_tiles; }

 private:
  struct Helped {
    Rank owner;
    std::vector<RayTask> rays;
    /// The link across which the rays came, and whose credit they take up; nothing once set aside.
    std::optional<std::uint32_t> bit;
  };
  struct OpenTile {
    TileWork work;
    std::uint32_t next_pixel = 0;
  };
  std::optional<TileWork> next_pixels(bool is_one_by_one, const TilePlan& plan);

  std::deque<ModelWork> models_;
  std::deque<std::uint32_t> tiles_;
  /// The tile whose pixels are handed out one by one.
  std::optional<OpenTile> open_;
  std::uint64_t own_tiles_, unassigned_;
  RayStore received_, own_;
  std::deque<Helped> helped_;
};

template <typename IsOwn>
std::size_t WorkQueue::own_tiles_at_end(std::size_t most, IsOwn&& is_own) const {
  std::size_t count = 0;
  while (count < std::min(most, tiles_.size()) && is_own(tiles_[tiles_.size() - 1 - count]))
    ++count;
  return count;
}

template <typename TakenFrom>
std::optional<WorkQueue::Piece> WorkQueue::take(const Pace& pace, bool may_start_tiles,
                                                const TilePlan& plan, TakenFrom&& taken_from) {
  if (!own_.is_empty()) {
    return Piece{RayWork{own_.take(pace.most_rays, [](std::uint32_t, std::size_t) {})},
                 std::nullopt, false};
  }
  if (!received_.is_empty()) {
    return Piece{RayWork{received_.take(pace.most_rays, taken_from)}, std::nullopt, true};
  }
  if (!helped_.empty()) {
    Helped first = std::move(helped_.front());
    helped_.pop_front();
    if (first.bit) taken_from(*first.bit, first.rays.size());
    return Piece{RayWork{std::move(first.rays)}, first.owner, false};
  }
  const auto pixels = may_start_tiles ? next_pixels(pace.is_one_by_one, plan) : std::nullopt;
  if (!pixels) return std::nullopt;
  return Piece{*pixels, std::nullopt, false};
}

}  // namespace graycube
