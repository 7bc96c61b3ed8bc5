// Outlines from a seed, and points in them by another way: the curves as polygons of many sides.
#pragma once

#include <cmath>
#include <utility>
#include <vector>

#include "csg/dice.hpp"
#include "geometry/infinity.hpp"
#include "outline/lathe.hpp"
#include "outline/sweep.hpp"

namespace graycube::testing {

/// An outline in the world's own frame, as a lathe and as a sweep from z = −0.5 to 0.5.
class Placed {
 public:
  explicit Placed(OutlineLoops loops, const Affine& to_local = {})
      : outline_(std::move(loops)), to_local_(to_local) {}

  const Outline& outline() const { return outline_; }
  PlacedOutline place() const { return {outline_, to_local_, bounds_, {0, 0, 1}, -0.5, 0.5}; }

 private:
  Outline outline_;
  Affine to_local_;
  Aabb bounds_{{-4, -4, -4}, {4, 4, 4}};
};

/// A straight segment's start and inner points.
inline void add_straight(OutlineLoop& loop, const OutlinePoint& a, const OutlinePoint& b) {
  loop.push_back(a);
  loop.push_back({a.x + (b.x - a.x) / 3, a.y + (b.y - a.y) / 3});
  loop.push_back({b.x - (b.x - a.x) / 3, b.y - (b.y - a.y) / 3});
}

/// A rectangle of straight segments.
inline OutlineLoop rectangle(const OutlinePoint& lo, const OutlinePoint& hi) {
  OutlineLoop loop;
  const OutlinePoint corners[] = {lo, {hi.x, lo.y}, hi, {lo.x, hi.y}};
  for (std::size_t i = 0; i < 4; ++i) add_straight(loop, corners[i], corners[(i + 1) % 4]);
  return loop;
}

/// Loops with curves and straight sides, level and upright ones among them, that cross themselves
/// as it comes; x ≥ 0, and some reach the axis.
inline OutlineLoops random_loops(Dice& dice) {
  OutlineLoops loops(1 + dice.below(3));
  const auto coordinate = [&](double lo) {
    return dice.one_in(3) ? 0.25 * std::floor(dice.between(4 * lo, 4.999)) : dice.between(lo, 1);
  };
  const auto point = [&] { return OutlinePoint{coordinate(0), coordinate(-1)}; };
  for (OutlineLoop& loop : loops) {
    std::vector<OutlinePoint> joints(2 + dice.below(6));
    for (OutlinePoint& joint : joints) joint = point();
    for (std::size_t i = 0; i < joints.size(); ++i) {
      OutlinePoint& to = joints[(i + 1) % joints.size()];
      if (i + 1 < joints.size() && dice.one_in(4))
        (dice.one_in(2) ? to.x = joints[i].x : to.y = joints[i].y);
      if (dice.one_in(2)) {
        add_straight(loop, joints[i], to);
      } else {
        loop.insert(loop.end(), {joints[i], point(), point()});
      }
    }
  }
  return loops;
}

/// The curves as polygons.
class Polygons {
 public:
  /// Larger than the distance of the polygons from the curves of random_loops(), whose second
  /// derivatives are below 24: 24 / 8 / 64² < 10⁻³.
  static constexpr double kError = 1e-3;

  explicit Polygons(const OutlineLoops& loops) {
    constexpr int kSides = 64;
    for (const OutlineLoop& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); i += 3) {
        for (int k = 0; k < kSides; ++k)
          sides_.push_back(
              {at(loop, i, k / double{kSides}), at(loop, i, (k + 1) / double{kSides})});
      }
    }
  }

  bool contains(double x, double y) const {
    bool inside = false;
    for (const auto& [a, b] : sides_) {
      if ((a.y < y) == (b.y < y)) continue;
      if (a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x) > x) inside = !inside;
    }
    return inside;
  }
  /// Whether no side is near the point.
  bool is_clear(double x, double y, double distance) const {
    for (const auto& [a, b] : sides_) {
      const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
      double along = square > 0 ? ((x - a.x) * dx + (y - a.y) * dy) / square : 0.0;
      along = std::fmin(1, std::fmax(0, along));
      if (std::hypot(x - a.x - along * dx, y - a.y - along * dy) < distance) return false;
    }
    return true;
  }

 private:
  static OutlinePoint at(const OutlineLoop& loop, std::size_t i, double u) {
    const OutlinePoint &a = loop[i], &b = loop[i + 1], &c = loop[i + 2];
    const OutlinePoint& d = loop[(i + 3) % loop.size()];
    const double v = 1 - u;
    const double wa = v * v * v, wb = 3 * v * v * u, wc = 3 * v * u * u, wd = u * u * u;
    return {wa * a.x + wb * b.x + wc * c.x + wd * d.x, wa * a.y + wb * b.y + wc * c.y + wd * d.y};
  }
  std::vector<std::pair<OutlinePoint, OutlinePoint>> sides_;
};

inline bool is_within(const Spans& spans, double t) {
  for (int i = 0; i < spans.count; ++i) {
    const auto& s = spans.interval[static_cast<std::size_t>(i)];
    if (t >= s.enter && t <= s.leave) return true;
  }
  return false;
}
/// Ordered, apart from each other, without NaN.
inline bool are_in_order(const Spans& spans) {
  double last = -kInf;
  for (int i = 0; i < spans.count; ++i) {
    const auto& s = spans.interval[static_cast<std::size_t>(i)];
    if (!(s.enter >= last && s.leave >= s.enter)) return false;
    last = s.leave;
  }
  return true;
}

}  // namespace graycube::testing
