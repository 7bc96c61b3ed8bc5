#include "flat/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <polyclipping/clipper.hpp>
#include <utility>

#include "flat/simple_outlines.hpp"

namespace graycube {
namespace {

using ClipperLib::cInt;

/// Bits of the largest coordinate on Clipper's grid: far fewer than 53, as its slopes are doubles.
constexpr int kGridBits = 40;
/// The most corners of outlines that Clipper splits where they touch themselves: 0.3 s.
constexpr std::size_t kMaxSplitCorners = std::size_t{1} << 14;

/// An exact sum of doubles, each part below the last bit of the next (Shewchuk 1997,
/// Grow-Expansion).
class ExactSum {
 public:
  void add(double value) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      const double sum = value + part_[i];
      const double other = sum - value;
      const double rest = (value - (sum - other)) + (part_[i] - other);
      value = sum;
      if (rest != 0) part_[kept++] = rest;
    }
    part_[kept++] = value;
    count_ = kept;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  int sign() const {
    for (std::size_t i = count_; i-- > 0;) {
      if (part_[i] != 0) return part_[i] > 0 ? 1 : -1;
    }
    return 0;
  }

 private:
  std::array<double, 16> part_{};
  std::size_t count_ = 0;
};

int exact_orientation(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  ExactSum sum;
  sum.add_product(a.x, b.y);
  sum.add_product(-a.y, b.x);
  sum.add_product(b.x, c.y);
  sum.add_product(-b.y, c.x);
  sum.add_product(c.x, a.y);
  sum.add_product(-c.y, a.x);
  return sum.sign();
}

/// The coordinate from which each integer was rounded, so that corners get their own values back.
class Axis {
 public:
  void note(cInt place, double value) { known_.emplace_back(place, value); }
  void finish() { std::sort(known_.begin(), known_.end()); }
  double value(cInt place, double unit) const {
    const auto at = std::lower_bound(known_.begin(), known_.end(), place,
                                     [](const auto& entry, cInt p) { return entry.first < p; });
    if (at != known_.end() && at->first == place) return at->second;
    return static_cast<double>(place) * unit;
  }

 private:
  std::vector<std::pair<cInt, double>> known_;
};

class Grid {
 public:
  /// `reach` is how far results may lie beyond the operands.
  explicit Grid(std::span<const FlatLoops> operands, double reach = 0) {
    double largest = 0;
    for (const FlatLoops& loops : operands) {
      for (const FlatLoop& loop : loops) {
        for (const FlatPoint& p : loop) {
          largest = std::max({largest, std::fabs(p.x), std::fabs(p.y)});
        }
      }
    }
    int exponent = 0;
    std::frexp(largest + reach, &exponent);
    unit_ = std::ldexp(1.0, exponent - kGridBits);
  }

  ClipperLib::Paths placed(const FlatLoops& loops) {
    ClipperLib::Paths paths;
    for (const FlatLoop& loop : loops) {
      ClipperLib::Path path;
      for (const FlatPoint& p : loop) {
        const cInt x = place(p.x), y = place(p.y);
        path.emplace_back(x, y);
        x_.note(x, p.x);
        y_.note(y, p.y);
      }
      paths.push_back(std::move(path));
    }
    return paths;
  }
  FlatLoop taken_back(const ClipperLib::Path& path) {
    FlatLoop loop;
    for (const ClipperLib::IntPoint& p : path) {
      const FlatPoint point{x_.value(p.X, unit_), y_.value(p.Y, unit_)};
      if (loop.empty() || !(loop.back() == point)) loop.push_back(point);
    }
    while (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
    return loop;
  }
  FlatLoops taken_back(const ClipperLib::Paths& paths) {
    finish();
    FlatLoops loops;
    for (const ClipperLib::Path& path : paths) {
      FlatLoop loop = taken_back(path);
      if (loop.size() >= 3) loops.push_back(std::move(loop));
    }
    return loops;
  }
  void finish() {
    x_.finish();
    y_.finish();
  }
  double unit() const { return unit_; }

 private:
  cInt place(double v) const { return static_cast<cInt>(std::nearbyint(v / unit_)); }

  double unit_ = 1;
  Axis x_, y_;
};

std::size_t corners_of(std::span<const FlatLoops> operands) {
  std::size_t corners = 0;
  for (const FlatLoops& loops : operands) {
    for (const FlatLoop& loop : loops) corners += loop.size();
  }
  return corners;
}

/// Clipper, told to split outlines that touch themselves, unless they have so many corners that it
/// would take minutes: it compares each corner of an outline with all others.
class SplittingClipper : public ClipperLib::Clipper {
 public:
  explicit SplittingClipper(std::size_t corners) { StrictlySimple(corners <= kMaxSplitCorners); }
};

ClipperLib::Paths simplified(const ClipperLib::Paths& paths) {
  std::size_t corners = 0;
  for (const ClipperLib::Path& path : paths) corners += path.size();
  SplittingClipper clipper(corners);
  clipper.AddPaths(paths, ClipperLib::ptSubject, true);
  ClipperLib::Paths result;
  clipper.Execute(ClipperLib::ctUnion, result, ClipperLib::pftEvenOdd);
  return result;
}

/// The parts of a figure of many corners that Clipper isn't needed for.
std::optional<std::vector<FlatRegion>> many_simple_regions(const FlatLoops& loops) {
  if (corners_of(std::span(&loops, 1)) <= kManyFlatCorners) return std::nullopt;
  return simple_regions(loops);
}

void add_regions(const ClipperLib::PolyNode& parent, Grid& grid, std::vector<FlatRegion>& regions) {
  for (const ClipperLib::PolyNode* outer : parent.Childs) {
    FlatRegion region{grid.taken_back(outer->Contour), {}};
    for (const ClipperLib::PolyNode* hole : outer->Childs) {
      FlatLoop loop = grid.taken_back(hole->Contour);
      if (loop.size() >= 3) region.holes.push_back(std::move(loop));
      add_regions(*hole, grid, regions);
    }
    if (region.outline.size() >= 3) regions.push_back(std::move(region));
  }
}

}  // namespace

FlatMap compose(const FlatMap& then, const FlatMap& first) {
  FlatMap r;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      r.m[i][j] = then.m[i][0] * first.m[0][j] + then.m[i][1] * first.m[1][j] +
                  (j == 2 ? then.m[i][2] : 0.0);
    }
  }
  return r;
}

FlatLoops mapped(const FlatMap& map, FlatLoops loops) {
  if (map == FlatMap{}) return loops;
  for (FlatLoop& loop : loops) {
    for (FlatPoint& p : loop) p = map(p);
    if (map.determinant() < 0) std::reverse(loop.begin(), loop.end());
  }
  return loops;
}

int orientation(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c) {
  // Shewchuk's bound for the rounded determinant: (3 + 16 ε) ε, ε = 2^-53.
  constexpr double kBound = 3.3306690738754716e-16;
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double area = left - right;
  const double error = kBound * (std::fabs(left) + std::fabs(right));
  if (area > error) return 1;
  if (area < -error) return -1;
  return exact_orientation(a, b, c);
}

bool is_within(std::span<const FlatLoop> loops, const FlatPoint& p) {
  bool inside = false;
  for (const FlatLoop& loop : loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const FlatPoint& a = loop[i];
      const FlatPoint& b = loop[(i + 1) % loop.size()];
      if ((a.y > p.y) == (b.y > p.y)) continue;
      const int side = orientation(a, b, p);
      if (a.y > b.y ? side < 0 : side > 0) inside = !inside;
    }
  }
  return inside;
}

std::array<FlatPoint, 2> flat_bounds(std::span<const FlatLoop> loops) {
  FlatPoint lo = loops.front().front(), hi = lo;
  for (const FlatLoop& loop : loops) {
    for (const FlatPoint& p : loop) {
      lo = {std::min(lo.x, p.x), std::min(lo.y, p.y)};
      hi = {std::max(hi.x, p.x), std::max(hi.y, p.y)};
    }
  }
  return {lo, hi};
}

// Andrew's monotone chain.
FlatLoop flat_hull(std::vector<FlatPoint> points) {
  const auto before = [](const FlatPoint& a, const FlatPoint& b) {
    return a.x != b.x ? a.x < b.x : a.y < b.y;
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  FlatLoop hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t start = hull.size();
    for (auto p = begin; p != end; ++p) {
      while (hull.size() >= start + 2 && orientation(hull[hull.size() - 2], hull.back(), *p) <= 0)
        hull.pop_back();
      hull.push_back(*p);
    }
    hull.pop_back();
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

FlatLoops loops_of(std::vector<FlatRegion> regions) {
  FlatLoops loops;
  for (FlatRegion& region : regions) {
    loops.push_back(std::move(region.outline));
    for (FlatLoop& hole : region.holes) loops.push_back(std::move(hole));
  }
  return loops;
}

FlatLoops wound(std::span<const FlatLoops> operands) {
  Grid grid(operands);
  ClipperLib::Clipper clipper;
  for (const FlatLoops& loops : operands)
    clipper.AddPaths(grid.placed(loops), ClipperLib::ptSubject, true);
  ClipperLib::Paths result;
  clipper.Execute(ClipperLib::ctUnion, result, ClipperLib::pftNonZero);
  return grid.taken_back(result);
}

FlatLoops combined(FlatOperation operation, std::span<const FlatLoops> operands) {
  if (operands.empty()) return {};
  if (operands.size() == 1) {
    if (auto regions = many_simple_regions(operands.front())) return loops_of(*std::move(regions));
  }
  Grid grid(operands);
  SplittingClipper clipper(corners_of(operands));
  ClipperLib::Paths result = simplified(grid.placed(operands.front()));
  if (operation == FlatOperation::kIntersection) {
    for (const FlatLoops& loops : operands.subspan(1)) {
      clipper.Clear();
      clipper.AddPaths(result, ClipperLib::ptSubject, true);
      clipper.AddPaths(simplified(grid.placed(loops)), ClipperLib::ptClip, true);
      clipper.Execute(ClipperLib::ctIntersection, result, ClipperLib::pftNonZero,
                      ClipperLib::pftNonZero);
    }
    return grid.taken_back(result);
  }
  clipper.AddPaths(result, ClipperLib::ptSubject, true);
  for (const FlatLoops& loops : operands.subspan(1)) {
    clipper.AddPaths(simplified(grid.placed(loops)), ClipperLib::ptClip, true);
  }
  clipper.Execute(
      operation == FlatOperation::kUnion ? ClipperLib::ctUnion : ClipperLib::ctDifference, result,
      ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  return grid.taken_back(result);
}

FlatLoops resolved(const FlatLoops& loops) {
  return combined(FlatOperation::kUnion, std::span(&loops, 1));
}

std::vector<FlatRegion> regions_of(const FlatLoops& loops) {
  if (auto regions = many_simple_regions(loops)) return *std::move(regions);
  Grid grid(std::span(&loops, 1));
  SplittingClipper clipper(corners_of(std::span(&loops, 1)));
  clipper.AddPaths(grid.placed(loops), ClipperLib::ptSubject, true);
  ClipperLib::PolyTree tree;
  clipper.Execute(ClipperLib::ctUnion, tree, ClipperLib::pftEvenOdd);
  grid.finish();
  std::vector<FlatRegion> regions;
  add_regions(tree, grid, regions);
  return regions;
}

namespace {

FlatLoops offset_paths(Grid& grid, const ClipperLib::Paths& paths, double distance, FlatJoin join,
                       double arc_tolerance) {
  ClipperLib::ClipperOffset clipper(join == FlatJoin::kMiter ? kFlatMiterLimit : 2.0,
                                    join == FlatJoin::kRound ? arc_tolerance / grid.unit() : 1.0);
  const ClipperLib::JoinType kind = join == FlatJoin::kRound   ? ClipperLib::jtRound
                                    : join == FlatJoin::kMiter ? ClipperLib::jtMiter
                                                               : ClipperLib::jtSquare;
  clipper.AddPaths(paths, kind, ClipperLib::etClosedPolygon);
  ClipperLib::Paths result;
  clipper.Execute(result, distance / grid.unit());
  return grid.taken_back(result);
}

}  // namespace

FlatLoops offset(const FlatLoops& loops, double distance, FlatJoin join, double arc_tolerance) {
  Grid grid(std::span(&loops, 1), std::fabs(distance));
  return offset_paths(grid, simplified(grid.placed(loops)), distance, join, arc_tolerance);
}

FlatLoops offset_simple(const FlatLoops& loops, double distance, FlatJoin join,
                        double arc_tolerance) {
  Grid grid(std::span(&loops, 1), std::fabs(distance));
  return offset_paths(grid, grid.placed(loops), distance, join, arc_tolerance);
}

bool is_covered(const FlatLoops& inner, const FlatLoops& outer) {
  const FlatLoops both[] = {inner, outer};
  Grid grid(both);
  ClipperLib::Clipper clipper;
  clipper.AddPaths(grid.placed(inner), ClipperLib::ptSubject, true);
  clipper.AddPaths(grid.placed(outer), ClipperLib::ptClip, true);
  ClipperLib::Paths rest;
  clipper.Execute(ClipperLib::ctDifference, rest, ClipperLib::pftEvenOdd, ClipperLib::pftEvenOdd);
  return rest.empty();
}

std::size_t resolved_count(const FlatLoops& loops) {
  Grid grid(std::span(&loops, 1));
  ClipperLib::Clipper clipper;
  clipper.AddPaths(grid.placed(loops), ClipperLib::ptSubject, true);
  ClipperLib::Paths result;
  clipper.Execute(ClipperLib::ctUnion, result, ClipperLib::pftEvenOdd);
  return result.size();
}

}  // namespace graycube
