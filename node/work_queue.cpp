#include "node/work_queue.hpp"

namespace graycube {

WorkQueue::WorkQueue(std::uint64_t own_tiles, bool is_one_by_one)
    : own_tiles_(own_tiles), unassigned_(own_tiles) {
  received_.set_fifo(is_one_by_one);
}

void WorkQueue::reset() {
  std::erase_if(models_, [](const ModelWork& m) { return !std::holds_alternative<CopyWork>(m); });
  tiles_.clear();
  open_.reset();
  unassigned_ = own_tiles_;
  received_.clear();
  own_.clear();
  helped_.clear();
}

std::optional<WorkQueue::ModelWork> WorkQueue::take_model() {
  if (models_.empty()) return std::nullopt;
  ModelWork first = std::move(models_.front());
  models_.pop_front();
  return first;
}

std::vector<std::uint32_t> WorkQueue::give_tiles(std::size_t count) {
  const auto end = tiles_.rbegin() + static_cast<std::ptrdiff_t>(std::min(count, tiles_.size()));
  std::vector<std::uint32_t> given(tiles_.rbegin(), end);
  tiles_.resize(tiles_.size() - given.size());
  return given;
}

void WorkQueue::add_helped(Rank owner, std::uint32_t bit, std::span<const RayTask> rays) {
  helped_.push_back({owner, {rays.begin(), rays.end()}, bit});
}

void WorkQueue::add_helped_again(Rank owner, std::vector<RayTask> rays) {
  helped_.push_front({owner, std::move(rays), std::nullopt});
}

std::size_t WorkQueue::held() const {
  std::size_t held = received_.size();
  for (const Helped& h : helped_) held += h.bit ? h.rays.size() : 0;
  return held;
}

/// Primary rays for an evaluator: those of a whole tile, or of one pixel.
std::optional<TileWork> WorkQueue::next_pixels(bool is_one_by_one, const TilePlan& plan) {
  if (!open_) {
    if (tiles_.empty()) return std::nullopt;
    open_ = OpenTile{{plan.rect(tiles_.front()), tiles_.front()}, 0};
    tiles_.pop_front();
  }
  if (!is_one_by_one) return std::exchange(open_, std::nullopt)->work;
  const PixelRect& tile = open_->work.rect;
  const std::uint32_t width = tile.x1 - tile.x0;
  const std::uint32_t x = tile.x0 + open_->next_pixel % width,
                      y = tile.y0 + open_->next_pixel / width;
  const TileWork pixel{{x, y, x + 1, y + 1}, open_->work.tile};
  if (++open_->next_pixel == width * (tile.y1 - tile.y0)) open_.reset();
  return pixel;
}

}  // namespace graycube
