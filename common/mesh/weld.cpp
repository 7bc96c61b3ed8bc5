#include "mesh/weld.hpp"

#include <array>
#include <cmath>
#include <unordered_map>

namespace graycube {
namespace {

/// Space in cells as wide as the tolerance: what is within it lies in a cell nearby.
class Cells {
 public:
  Cells(std::span<const Vec3> points, double width) : points_(points), width_(width) {
    first_.reserve(points.size());
    next_.resize(points.size(), kNone);
  }

  /// The first point within reach; kNone, after taking `i` in, if there is none.
  std::uint32_t first_near(std::uint32_t i) {
    const Cell own = cell_of(points_[i]);
    std::uint32_t found = kNone;
    for (int k = 0; k < 27; ++k) {
      const Cell cell{own[0] + k % 3 - 1, own[1] + k / 3 % 3 - 1, own[2] + k / 9 - 1};
      const auto place = first_.find(hash(cell));
      if (place == first_.end()) continue;
      for (std::uint32_t j = place->second; j != kNone; j = next_[j]) {
        if (j < found && max_abs(points_[j] - points_[i]) <= width_) found = j;
      }
    }
    if (found == kNone) take_in(i, hash(own));
    return found;
  }

  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

 private:
  using Cell = std::array<double, 3>;

  Cell cell_of(const Vec3& p) const {
    return {std::floor(p.x / width_), std::floor(p.y / width_), std::floor(p.z / width_)};
  }
  /// Cells that share a number only cost time.
  static std::uint64_t hash(const Cell& cell) {
    std::uint64_t h = 0;
    for (const double v : cell) {
      // Adding +0 turns −0 into +0.
      h = (h ^ std::hash<double>{}(v + 0.0)) * 0x9E3779B97F4A7C15u;
      h ^= h >> 29;
    }
    return h;
  }
  void take_in(std::uint32_t i, std::uint64_t cell) {
    const auto [place, is_new] = first_.try_emplace(cell, i);
    if (is_new) return;
    next_[i] = place->second;
    place->second = i;
  }

  std::span<const Vec3> points_;
  double width_;
  std::unordered_map<std::uint64_t, std::uint32_t> first_;
  std::vector<std::uint32_t> next_;
};

}  // namespace

std::vector<std::uint32_t> first_within(std::span<const Vec3> points, double tolerance) {
  std::vector<std::uint32_t> first(points.size());
  Cells cells(points, tolerance);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const std::uint32_t near = tolerance > 0 ? cells.first_near(i) : Cells::kNone;
    first[i] = near == Cells::kNone ? i : near;
  }
  return first;
}

}  // namespace graycube
