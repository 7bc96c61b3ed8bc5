#include "node/parts/sliding/generations.hpp"

#include <algorithm>
#include <utility>

namespace graycube {
namespace {

/// Whether these are as many boundaries as those, inside the picture, each beyond the one before.
bool are_boundaries(const std::vector<std::int64_t>& edges, const std::vector<std::int64_t>& like,
                    std::uint32_t side) {
  const auto does_not_grow = [](std::int64_t a, std::int64_t b) { return a >= b; };
  return edges.size() == like.size() &&
         std::ranges::adjacent_find(edges, does_not_grow) == edges.end() &&
         (edges.empty() || (edges.front() > 0 && edges.back() < side));
}

}  // namespace

Generations::Generations(std::shared_ptr<const Domain> first, std::uint32_t tiles, bool is_on)
    : is_on_(is_on && first->grid() != nullptr) {
  if (!is_on_) return;
  domains_[0] = std::move(first);
  parity_.assign(tiles, false);
}

bool Generations::hold(std::span<const RayTask> rays) const {
  return !is_on_ || std::ranges::all_of(rays, [this](const RayTask& ray) {
    return domains_[ray.generation] != nullptr;
  });
}

bool Generations::may_add(const control::Slide& m) const {
  if (!is_on_ || m.generation != current_ + 1 || domain_of(m.generation) != nullptr) return false;
  const Domain& now = *current_domain();
  const ImageSize& image = now.settings().image;
  return are_boundaries(m.column_edges, now.grid()->column_edges(), image.width) &&
         are_boundaries(m.row_edges, now.grid()->row_edges(), image.height);
}

void Generations::add(std::uint32_t generation, std::shared_ptr<const Domain> domain) {
  domains_[generation % kMostGenerations] = std::move(domain);
  std::uint64_t bytes = current_domain()->memory_bytes();
  const Domain& next = *domain_of(generation);
  if (next.territory() != current_domain()->territory()) bytes += next.memory_bytes();
  memory_peak_ = std::max(memory_peak_, bytes);
}

bool Generations::turn(const control::Turn& m) {
  const bool is_next = m.current == current_ + 1 && m.oldest == current_;
  const bool is_over = m.current == current_ && m.oldest == current_;
  if (!is_on_ || !(is_next || is_over) || domain_of(m.current) == nullptr) return false;
  current_ = m.current;
  if (is_over) domains_[(current_ + 1) % kMostGenerations] = nullptr;
  return true;
}

void Generations::report(control::NodeStats& stats) const {
  stats.memory_bytes = std::max(stats.memory_bytes, memory_peak_);
}

void Generations::reset() {
  if (is_on_) domains_[(current_ + 1) % kMostGenerations] = nullptr;
}

}  // namespace graycube
