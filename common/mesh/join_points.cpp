#include "mesh/join_points.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>

#include "stop_point.hpp"

namespace graycube {
namespace {

constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();
constexpr double kLeastShare = 1e-15;

using Cell = std::array<std::int64_t, 3>;

std::size_t hash(const Cell& cell) {
  std::uint64_t h = 0;
  for (const std::int64_t c : cell) {
    h = (h ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15u;
    h ^= h >> 29;
  }
  return static_cast<std::size_t>(h);
}

/// Points that are farther apart than `distance`, found by cells twice as wide: those near a point
/// are in the eight cells about it, and a cell holds few.
class PointGrid {
 public:
  PointGrid(std::span<const Vec3> points, std::size_t most, double distance)
      : points_(points), distance_(distance), slots_(std::bit_ceil(2 * most + 1), kNoPoint) {}

  /// The nearest point of the grid within the distance, or kNoPoint.
  std::uint32_t nearest(const Vec3& p) const {
    const Cell middle = cell_of(p, 0.5);
    std::uint32_t best = kNoPoint;
    double best_distance = distance_;
    for (unsigned corner = 0; corner < 8; ++corner) {
      Cell cell = middle;
      for (unsigned a = 0; a < 3; ++a) cell[a] -= corner >> a & 1;
      for (std::size_t slot = first_slot(cell); slots_[slot] != kNoPoint; slot = after(slot)) {
        const double d = max_abs(points_[slots_[slot]] - p);
        const bool is_nearer = d < best_distance || (d == best_distance && slots_[slot] < best);
        if (!is_nearer) continue;
        best = slots_[slot];
        best_distance = d;
      }
    }
    return best;
  }

  void add(std::uint32_t i) {
    std::size_t slot = first_slot(cell_of(points_[i], 0));
    while (slots_[slot] != kNoPoint) slot = after(slot);
    slots_[slot] = i;
  }

 private:
  Cell cell_of(const Vec3& p, double offset) const {
    Cell cell{};
    for (int a = 0; a < 3; ++a) {
      cell[static_cast<std::size_t>(a)] =
          static_cast<std::int64_t>(std::floor(p[a] / (2 * distance_) + offset));
    }
    return cell;
  }
  std::size_t first_slot(const Cell& cell) const { return hash(cell) & (slots_.size() - 1); }
  std::size_t after(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }

  std::span<const Vec3> points_;
  double distance_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace

std::vector<std::uint32_t> joined_points(std::span<const Vec3> points,
                                         std::span<const std::uint32_t> chosen, double distance) {
  std::vector<std::uint32_t> number(points.size());
  std::iota(number.begin(), number.end(), 0u);
  double largest = 0;
  for (const std::uint32_t i : chosen) largest = std::max(largest, max_abs(points[i]));
  // Cells farther out couldn't be counted.
  if (!(distance > kLeastShare * largest) || !std::isfinite(distance)) return number;
  PointGrid grid(points, chosen.size(), distance);
  for (const std::uint32_t i : chosen) {
    stop_if_asked();
    const std::uint32_t near = grid.nearest(points[i]);
    if (near == kNoPoint) {
      grid.add(i);
    } else {
      number[i] = near;
    }
  }
  return number;
}

}  // namespace graycube
