#include "formats/openscad/hulls/round_caps.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "flat/rounds.hpp"
#include "geometry/infinity.hpp"

namespace graycube {
namespace {

/// Rounding errors, relative to the extent of all items.
constexpr double kRounding = 1e-12;

class Caps {
 public:
  explicit Caps(std::span<const BallOrDisc> items) : items_(items) {
    low_ = kInf;
    high_ = -low_;
    for (const auto& [p, is_disc] : items) {
      const double up = is_disc ? 0 : p.radius;
      low_ = std::min(low_, p.center.z - up);
      high_ = std::max(high_, p.center.z + up);
      extent_ = std::max(extent_, p.radius + max_abs(p.center - items.front().round.center));
    }
    tolerance_ = kRounding * extent_;
  }

  bool are_exact() const {
    bool is_cut_low = false, is_cut_high = false;
    for (const BallOrDisc& item : items_) {
      if (!item.is_disc) continue;
      const bool is_lowest = item.round.center.z <= low_ + tolerance_,
                 is_highest = item.round.center.z >= high_ - tolerance_;
      if (!is_lowest && !has_support(item.round, -1)) return false;
      if (!is_highest && !has_support(item.round, 1)) return false;
      is_cut_low = is_cut_low || is_lowest;
      is_cut_high = is_cut_high || is_highest;
    }
    return (!is_cut_low || holds_all(low_)) && (!is_cut_high || holds_all(high_));
  }

  /// Wider than all items, so that only its bottom and top cut, and these only where discs are.
  BoxShape box() const {
    const Vec3 middle = items_.front().round.center, wide{2 * extent_, 2 * extent_, 2 * extent_};
    BoxShape box{middle - wide, middle + wide};
    for (const BallOrDisc& item : items_) {
      if (!item.is_disc) continue;
      if (item.round.center.z <= low_ + tolerance_) box.min.z = low_;
      if (item.round.center.z >= high_ - tolerance_) box.max.z = high_;
    }
    return box;
  }

 private:
  bool is_in_column(const RoundPoint& p, const RoundPoint& column) const {
    const double dx = p.center.x - column.center.x, dy = p.center.y - column.center.y;
    return std::sqrt(dx * dx + dy * dy) + p.radius <= column.radius + tolerance_;
  }

  bool has_support(const RoundPoint& disc, int side) const {
    return std::any_of(items_.begin(), items_.end(), [&](const BallOrDisc& other) {
      const double distance = side * (other.round.center.z - disc.center.z);
      return is_in_column(disc, other.round) &&
             distance >= (other.is_disc ? disc.radius : 0) - tolerance_;
    });
  }

  bool holds_all(double z) const {
    std::vector<FlatDisk> disks;
    std::size_t at_cut = 0;
    const auto is_at_cut = [&](const BallOrDisc& item) {
      return std::fabs(item.round.center.z - z) <= tolerance_ &&
             (item.is_disc || item.round.radius == 0);
    };
    for (const bool is_cut : {true, false}) {
      for (const BallOrDisc& item : items_) {
        if (is_at_cut(item) != is_cut || (!is_cut && is_in_some_column(item.round, disks, at_cut)))
          continue;
        disks.push_back({{item.round.center.x, item.round.center.y}, item.round.radius, 0});
      }
      if (is_cut) at_cut = disks.size();
    }
    if (disks.size() * disks.size() > kMaxFlatDiskPairs) return false;
    const FlatRoundHull hull = flat_round_hull(disks);
    const bool none_shows = std::all_of(hull.disks.begin(), hull.disks.end(),
                                        [&](std::size_t i) { return i < at_cut; });
    const auto is_corner = [&](const FlatDisk& d) {
      return d.radius == 0 &&
             std::find(hull.polygon.begin(), hull.polygon.end(), d.center) != hull.polygon.end();
    };
    return none_shows && std::none_of(disks.begin() + static_cast<std::ptrdiff_t>(at_cut),
                                      disks.end(), is_corner);
  }

  bool is_in_some_column(const RoundPoint& p, const std::vector<FlatDisk>& disks,
                         std::size_t count) const {
    return std::any_of(disks.begin(), disks.begin() + static_cast<std::ptrdiff_t>(count),
                       [&](const FlatDisk& d) {
                         return is_in_column(p, {{d.center.x, d.center.y, 0}, d.radius});
                       });
  }

  std::span<const BallOrDisc> items_;
  double low_ = 0, high_ = 0, extent_ = 0, tolerance_ = 0;
};

}  // namespace

std::optional<RoundSolid> capped_solid(std::span<const BallOrDisc> items, bool& is_too_large) {
  is_too_large = items.size() > kMaxHullPoints;
  if (is_too_large) return std::nullopt;
  const Caps caps(items);
  if (!caps.are_exact()) return std::nullopt;
  std::vector<RoundPoint> balls;
  for (const BallOrDisc& item : items) balls.push_back(item.round);
  auto solid = round_solid(RoundKind::kBalls, std::move(balls), is_too_large);
  if (!solid) return std::nullopt;
  std::vector<CsgNode> children;
  children.push_back(std::move(solid->node));
  children.push_back({caps.box(), std::nullopt, kInheritMaterial});
  solid->node = {OperationNode{Operation::kIntersection, std::move(children)}, std::nullopt,
                 kInheritMaterial};
  // The corners of the balls' hull reach beyond the cuts.
  for (Vec3& corner : solid->corners)
    corner.z = std::clamp(corner.z, caps.box().min.z, caps.box().max.z);
  return solid;
}

}  // namespace graycube
