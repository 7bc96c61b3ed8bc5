// Arcs of the unit circle, cut down one half-plane after another.
#pragma once

#include <cstddef>
#include <vector>

#include "flat/polygon.hpp"

namespace graycube {

/// Closed arcs, none shorter than kLeastArc. Positions on the circle go from 0 to 4 once around,
/// along the square |x| + |y| = 1: trigonometry's last bits differ between machines.
class CircleArcs {
 public:
  /// Shorter arcs are single points but for rounding. (Leaving one out moves the surface of a unit
  /// circle by 1e-15.)
  static constexpr double kLeastArc = 1e-7;
  static constexpr std::size_t kNobody = static_cast<std::size_t>(-1);

  struct End {
    double position = 0;
    FlatPoint direction;
    /// The number, given to keep(), of the half-plane that ends the arc here.
    std::size_t cutter = kNobody;
  };
  /// The arc from `from` counter-clockwise to `to`, at most once around.
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
