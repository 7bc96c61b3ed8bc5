#include "flat/flush.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "written_digits.hpp"

namespace graycube {
namespace {

/// The binary exponent, relative to the largest coordinate's, of four steps of Clipper's grid.
constexpr int kGridSteps = -38;
/// The tolerance is at most this share of the shortest side, so that details keep their corners.
constexpr double kShareOfSide = 0.25;

bool is_before(const FlatPoint& a, const FlatPoint& b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}
double squared_distance(const FlatPoint& a, const FlatPoint& b) {
  return (a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y);
}

/// The place of p along the side from a to b, between 0 and 1, if it is within the tolerance of the
/// side and not at its ends; else −1.
double place_on_side(const FlatPoint& a, const FlatPoint& b, const FlatPoint& p, double tolerance) {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  const double along = ((p.x - a.x) * dx + (p.y - a.y) * dy) / square;
  const double across = (p.x - a.x) * dy - (p.y - a.y) * dx;
  const bool is_near = along > 0 && along < 1 && across * across <= tolerance * tolerance * square;
  return is_near ? along : -1;
}

/// The corners that stay, with a search for the one that is near a point.
class Corners {
 public:
  Corners(std::span<const FlatLoops> operands, double tolerance) : tolerance_(tolerance) {
    std::vector<FlatPoint> all;
    for (const FlatLoops& loops : operands) {
      for (const FlatLoop& loop : loops) all.insert(all.end(), loop.begin(), loop.end());
    }
    std::sort(all.begin(), all.end(), is_before);
    for (const FlatPoint& p : all) {
      if (near(p) != nullptr) continue;
      cells_[cell_of(p)].push_back(p);
      by_x_.push_back(p);
    }
  }
  /// The corner that stays in place of one of the operands' corners.
  const FlatPoint& of(const FlatPoint& p) const { return *near(p); }
  /// Appends the corners on the side from a to b, without its ends, in order.
  void on_side(const FlatPoint& a, const FlatPoint& b, FlatLoop& out) const {
    const double lo_x = std::min(a.x, b.x) - tolerance_, hi_x = std::max(a.x, b.x) + tolerance_;
    const double lo_y = std::min(a.y, b.y) - tolerance_, hi_y = std::max(a.y, b.y) + tolerance_;
    std::vector<std::pair<double, FlatPoint>> found;
    const auto begin = std::lower_bound(by_x_.begin(), by_x_.end(), lo_x,
                                        [](const FlatPoint& p, double x) { return p.x < x; });
    for (auto p = begin; p != by_x_.end() && p->x <= hi_x; ++p) {
      if (p->y < lo_y || p->y > hi_y || *p == a || *p == b) continue;
      const double place = place_on_side(a, b, *p, tolerance_);
      if (place > 0) found.emplace_back(place, *p);
    }
    std::sort(found.begin(), found.end(),
              [](const auto& s, const auto& t) { return s.first < t.first; });
    for (const auto& [place, p] : found) out.push_back(p);
  }

 private:
  using Cell = std::pair<double, double>;
  Cell cell_of(const FlatPoint& p) const {
    return {std::floor(p.x / tolerance_), std::floor(p.y / tolerance_)};
  }
  /// The first corner within the tolerance of p; null if there is none.
  const FlatPoint* near(const FlatPoint& p) const {
    const Cell cell = cell_of(p);
    const FlatPoint* first = nullptr;
    for (int i = 0; i < 9; ++i) {
      const auto at = cells_.find({cell.first + i % 3 - 1, cell.second + i / 3 - 1});
      if (at == cells_.end()) continue;
      for (const FlatPoint& q : at->second) {
        if (squared_distance(p, q) > tolerance_ * tolerance_) continue;
        if (first == nullptr || is_before(q, *first)) first = &q;
      }
    }
    return first;
  }

  double tolerance_;
  std::map<Cell, std::vector<FlatPoint>> cells_;
  std::vector<FlatPoint> by_x_;
};

/// Corners of an operation's figures, in order.
struct Met {
  /// Corners of two loops, or of one and on a side of another: sides may go on straight there.
  std::vector<FlatPoint> shared;
  /// Corners of all loops.
  std::vector<FlatPoint> own;

  void finish() {
    std::sort(own.begin(), own.end(), is_before);
    for (std::size_t i = 1; i < own.size(); ++i) {
      if (own[i] == own[i - 1]) shared.push_back(own[i]);
    }
    std::sort(shared.begin(), shared.end(), is_before);
  }
  bool is_shared(const FlatPoint& p) const {
    return std::binary_search(shared.begin(), shared.end(), p, is_before);
  }
};

/// The loop led through the corners that stay; notes in `met` where it met others.
FlatLoop through_corners(const FlatLoop& loop, const Corners& corners, Met& met) {
  FlatLoop own, out;
  for (const FlatPoint& p : loop) {
    const FlatPoint& corner = corners.of(p);
    if (own.empty() || !(own.back() == corner)) own.push_back(corner);
  }
  while (own.size() > 1 && own.front() == own.back()) own.pop_back();
  if (own.size() < 3) return {};
  met.own.insert(met.own.end(), own.begin(), own.end());
  for (std::size_t i = 0; i < own.size(); ++i) {
    out.push_back(own[i]);
    const std::size_t before = out.size();
    corners.on_side(own[i], own[(i + 1) % own.size()], out);
    met.shared.insert(met.shared.end(), out.begin() + static_cast<std::ptrdiff_t>(before),
                      out.end());
  }
  return out;
}

std::vector<FlatLoops> through_corners(std::span<const FlatLoops> operands, double tolerance,
                                       Met& met) {
  const Corners corners(operands, tolerance);
  std::vector<FlatLoops> result(operands.size());
  for (std::size_t i = 0; i < operands.size(); ++i) {
    for (const FlatLoop& loop : operands[i]) {
      FlatLoop through = through_corners(loop, corners, met);
      if (through.size() >= 3) result[i].push_back(std::move(through));
    }
  }
  return result;
}

/// How far clockwise from a the point c lies, seen from b: above 0, at most 4, growing with the
/// angle. The least of several is the sharpest turn to the left on the way from a over b.
double turn_from_back(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  const double ux = a.x - b.x, uy = a.y - b.y, vx = c.x - b.x, vy = c.y - b.y;
  const double left = ux * vy - uy * vx, ahead = ux * vx + uy * vy;
  const double share = ahead / (std::fabs(ahead) + std::fabs(left));  // 1 back, −1 straight on
  return left < 0 ? 1 - share : 3 + share;
}

/// Outlines as sets of sides. Sides that go both ways bound nothing and cancel each other: such are
/// the walls of no thickness that Clipper leaves, and slivers of two sides.
class Sides {
 public:
  void add(const FlatLoop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) add(loop[i], loop[(i + 1) % loop.size()]);
  }
  /// The loops that the sides make, each turning as far to the left as it can, so that none crosses
  /// itself.
  FlatLoops loops() {
    FlatLoops result;
    for (auto& [corner, ends] : from_) {
      while (!ends.empty()) {
        FlatLoop loop = taken_from(corner);
        if (loop.size() >= 3) result.push_back(std::move(loop));
      }
    }
    return result;
  }

 private:
  struct Before {
    bool operator()(const FlatPoint& a, const FlatPoint& b) const { return is_before(a, b); }
  };

  void add(const FlatPoint& a, const FlatPoint& b) {
    const auto back = from_.find(b);
    if (back != from_.end()) {
      const auto same = std::find(back->second.begin(), back->second.end(), a);
      if (same != back->second.end()) {
        back->second.erase(same);
        return;
      }
    }
    from_[a].push_back(b);
  }
  FlatLoop taken_from(const FlatPoint& start) {
    FlatLoop loop{start};
    FlatPoint before = start, at = start;
    do {
      std::vector<FlatPoint>& ends = from_[at];
      if (ends.empty()) return {};
      const auto next =
          std::min_element(ends.begin(), ends.end(), [&](const FlatPoint& p, const FlatPoint& q) {
            return turn_from_back(before, at, p) < turn_from_back(before, at, q);
          });
      before = std::exchange(at, *next);
      ends.erase(next);
      if (!(at == start)) loop.push_back(at);
    } while (!(at == start));
    return loop;
  }

  std::map<FlatPoint, std::vector<FlatPoint>, Before> from_;
};

/// Removes shared corners at which the side goes on straight.
void straighten(FlatLoop& loop, const Met& met, double tolerance) {
  FlatLoop out, skipped;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const FlatPoint& before = out.empty() ? loop.back() : out.back();
    const FlatPoint& after = loop[(i + 1) % loop.size()];
    const auto is_on = [&](const FlatPoint& p) {
      return place_on_side(before, after, p, tolerance) > 0;
    };
    const bool is_straight = met.is_shared(loop[i]) && !(before == after) && is_on(loop[i]) &&
                             std::all_of(skipped.begin(), skipped.end(), is_on);
    if (is_straight) {
      skipped.push_back(loop[i]);
    } else {
      out.push_back(loop[i]);
      skipped.clear();
    }
  }
  if (out.size() >= 3) loop = std::move(out);
}

}  // namespace

double flush_tolerance(std::span<const FlatLoops> operands, std::uint32_t digits) {
  double largest = 0, shortest = std::numeric_limits<double>::infinity();
  for (const FlatLoops& loops : operands) {
    for (const FlatLoop& loop : loops) {
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const FlatPoint& p = loop[i];
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y)});
        const double side = squared_distance(p, loop[(i + 1) % loop.size()]);
        if (side > 0) shortest = std::min(shortest, side);
      }
    }
  }
  int exponent = 0;
  std::frexp(largest, &exponent);
  // Less than a unit, so that coordinates that differ by one in the last digit stay apart.
  const double unit = 1.98 * half_unit(largest, digits);
  return std::max(std::min(unit, kShareOfSide * std::sqrt(shortest)),
                  std::ldexp(1.0, exponent + kGridSteps));
}

FlatLoops combined_flush(FlatOperation operation, std::span<const FlatLoops> operands,
                         double tolerance) {
  if (!(tolerance > 0)) return combined(operation, operands);
  // Corners of the rough result alone (in `again`) are no sign that sides met there.
  Met met, again;
  const FlatLoops rough = combined(operation, through_corners(operands, tolerance, met));
  Sides sides;
  for (const FlatLoops& loops : through_corners(std::span(&rough, 1), tolerance, again)) {
    for (const FlatLoop& loop : loops) sides.add(loop);
  }
  FlatLoops result = sides.loops();
  met.shared.insert(met.shared.end(), again.shared.begin(), again.shared.end());
  met.finish();
  for (FlatLoop& loop : result) straighten(loop, met, tolerance);
  return result;
}

}  // namespace graycube
