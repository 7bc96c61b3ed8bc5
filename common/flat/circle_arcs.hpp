// Arcs of the unit circle, cut down one half-plane after another.
#pragma once

#include <cstddef>
#include <vector>

#include "flat/polygon.hpp"

namespace graycube {

/// Closed arcs, none shorter than kLeastArc. Positions on the circle are measured without
/// trigonometry, whose last bits differ between machines: 0 to 4 once around, |x| + |y| being 1.
class CircleArcs {
 public:
  /// Shorter arcs are points by rounding. (Leaving one out moves the surface of a unit circle by
  /// 1e-15.)
  static constexpr double kLeastArc = 1e-7;
  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

  struct End {
    double position = 0;
    FlatPoint direction;
    /// Whose half-plane ends the arc here.
    std::size_t cutter = kNobody;
  };
  /// From `from` counter-clockwise to `to`, up to once around.
  struct Arc {
    End from, to;
    bool is_whole() const { return from.cutter == kNobody; }
  };

  CircleArcs() : arcs_{Arc{{0, {1, 0}, kNobody}, {4, {1, 0}, kNobody}}} {}

  /// Keeps the points with a x + b y ≤ c, up to `tolerance`.
  void keep(double a, double b, double c, double tolerance, std::size_t cutter);
  bool is_empty() const { return arcs_.empty(); }
  const std::vector<Arc>& arcs() const { return arcs_; }

 private:
  void keep_between(const End& from, const End& to);

  std::vector<Arc> arcs_;
};

}  // namespace graycube
