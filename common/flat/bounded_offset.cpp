#include "flat/bounded_offset.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "flat/pieces.hpp"
#include "flat/side_crossings.hpp"

namespace graycube {
namespace {

/// Sides that are united in the first step, in which all of them may cross.
constexpr std::size_t kFirstSides = 16;
/// A round join has no more facets than fit with one a step of Clipper's grid; this many at most.
constexpr double kMostFacetsOfTurn = 1 << 20;
/// The width of gaps that rounding leaves, as a share of the largest coordinate: some steps of
/// Clipper's grid.
constexpr double kGap = 0x1p-37;

FlatPoint moved(const FlatPoint& p, const FlatPoint& n, double by) {
  return {p.x + by * n.x, p.y + by * n.y};
}

/// How moved sides are joined, as Clipper joins them: arcs begin at the side before with facets of
/// equal angles, the last one being what is left.
class Joins {
 public:
  Joins(double distance, FlatJoin join, double arc_tolerance) : distance_(distance), join_(join) {
    const double radius = std::fabs(distance);
    const double sagitta = std::min(arc_tolerance, 0.25 * radius);
    const double facets = std::numbers::pi / std::acos(1 - sagitta / radius);
    facets_of_turn_ = std::min(facets, kMostFacetsOfTurn);
  }

  /// Appends the corners between the ends of the side before, with normal `a`, and the side after,
  /// with normal `b`, at the convex corner `at`.
  void add(const FlatPoint& at, const FlatPoint& a, const FlatPoint& b, FlatLoop& out) const {
    const double sine = a.x * b.y - a.y * b.x, cosine = a.x * b.x + a.y * b.y;
    if (join_ == FlatJoin::kRound) return add_arc(at, a, b, std::atan2(sine, cosine), out);
    if (join_ == FlatJoin::kMiter && 1 + cosine >= 2 / (kFlatMiterLimit * kFlatMiterLimit)) {
      out.push_back(moved(at, {a.x + b.x, a.y + b.y}, distance_ / (1 + cosine)));
      return;
    }
    const double along = std::tan(0.25 * std::atan2(sine, cosine));
    out.push_back(moved(at, {a.x - a.y * along, a.y + a.x * along}, distance_));
    out.push_back(moved(at, {b.x + b.y * along, b.y - b.x * along}, distance_));
  }
  std::size_t most_corners(double turn) const {
    if (join_ != FlatJoin::kRound) return 2;
    return 2 + static_cast<std::size_t>(facets_of_turn_ * std::fabs(turn) / (2 * std::numbers::pi));
  }

 private:
  void add_arc(const FlatPoint& at, const FlatPoint& a, const FlatPoint& b, double turn,
               FlatLoop& out) const {
    const double step = 2 * std::numbers::pi / facets_of_turn_;
    const auto facets = std::max(1L, std::lround(std::fabs(turn) / step));
    const double signed_step = turn < 0 ? -step : step;
    for (long i = 0; i < facets; ++i) {
      const double angle = signed_step * static_cast<double>(i);
      const double c = std::cos(angle), s = std::sin(angle);
      out.push_back(moved(at, {c * a.x - s * a.y, s * a.x + c * a.y}, distance_));
    }
    out.push_back(moved(at, b, distance_));
  }

  double distance_;
  FlatJoin join_;
  double facets_of_turn_ = 0;
};

/// The areas that sides sweep, each with the join at the corner where it begins.
class Sweeps {
 public:
  Sweeps(const FlatLoop& loop, double distance, const Joins& joins)
      : loop_(loop), distance_(distance), joins_(joins) {
    for (std::size_t i = 0; i < loop.size(); ++i)
      normals_.push_back(edge_between(loop[i], corner(i + 1)).normal);
  }

  std::size_t most_corners() const {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      const FlatPoint &a = before(i), &b = normals_[i];
      const double turn = std::atan2(a.x * b.y - a.y * b.x, a.x * b.x + a.y * b.y);
      sum += 3 + (is_joined(i) ? joins_.most_corners(turn) : 0);
    }
    return sum;
  }
  /// That of the sides from `begin` to `end`, in one outline: along the moved sides and back. It
  /// winds at least once round all that any of them sweeps.
  FlatLoop between(std::size_t begin, std::size_t end) const {
    FlatLoop swept{loop_[begin]};
    for (std::size_t i = begin; i < end; ++i) {
      if (is_joined(i)) {
        if (i == begin) swept.push_back(moved(loop_[i], before(i), distance_));
        joins_.add(loop_[i], before(i), normals_[i], swept);
      } else {
        if (i > begin) swept.push_back(loop_[i]);
        swept.push_back(moved(loop_[i], normals_[i], distance_));
      }
      if (i + 1 == end || !is_joined(i + 1))
        swept.push_back(moved(corner(i + 1), normals_[i], distance_));
    }
    for (std::size_t i = end; i > begin; --i) swept.push_back(corner(i));
    return swept;
  }

 private:
  const FlatPoint& corner(std::size_t i) const { return loop_[i % loop_.size()]; }
  const FlatPoint& before(std::size_t i) const {
    return normals_[(i + normals_.size() - 1) % normals_.size()];
  }
  bool is_joined(std::size_t i) const {
    const FlatPoint &a = before(i), &b = normals_[i];
    return (a.x * b.y - a.y * b.x) * distance_ > 0;
  }

  const FlatLoop& loop_;
  double distance_;
  const Joins& joins_;
  std::vector<FlatPoint> normals_;
};

/// The areas that all sides sweep, in portions of few sides; nothing where they are too many.
std::optional<std::vector<FlatLoops>> swept_portions(const FlatLoops& loops, double distance,
                                                     const Joins& joins) {
  std::size_t corners = 0;
  std::vector<FlatLoops> portions;
  for (const FlatLoop& loop : loops) {
    const Sweeps sweeps(loop, distance, joins);
    corners += sweeps.most_corners();
    if (corners > kMaxSweptCorners) return std::nullopt;
    for (std::size_t begin = 0; begin < loop.size(); begin += kFirstSides)
      portions.push_back({sweeps.between(begin, std::min(loop.size(), begin + kFirstSides))});
  }
  return portions;
}

/// The union of the portions, two by two.
std::optional<FlatLoops> united(std::vector<FlatLoops> portions, std::size_t& left) {
  const auto wound_in_time = [&](std::span<const FlatLoops> operands) -> std::optional<FlatLoops> {
    if (!crossings_are_few(operands, left)) return std::nullopt;
    return wound(operands);
  };
  std::size_t together = 1;
  do {
    std::vector<FlatLoops> next;
    for (std::size_t i = 0; i < portions.size(); i += together) {
      const std::size_t count = std::min(together, portions.size() - i);
      auto sum = wound_in_time(std::span(portions).subspan(i, count));
      if (!sum) return std::nullopt;
      next.push_back(*std::move(sum));
    }
    portions = std::move(next);
    together = 2;
  } while (portions.size() > 1);
  return std::move(portions.front());
}

/// Whether a loop is more than the gap that rounding leaves between two areas.
bool is_more_than_rounding(const FlatLoop& loop, double distance) {
  double area = 0, length = 0, largest = std::fabs(distance);
  const FlatPoint& o = loop.front();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const FlatPoint &a = loop[i], &b = loop[(i + 1) % loop.size()];
    area += (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    length += std::hypot(b.x - a.x, b.y - a.y);
    largest = std::max({largest, std::fabs(a.x), std::fabs(a.y)});
  }
  return std::fabs(area) > kGap * largest * length;
}

/// The figure with what the portions sweep.
std::optional<FlatLoops> with_swept(const FlatLoops& loops, double distance,
                                    std::vector<FlatLoops> portions) {
  std::size_t left = kMaxSweptCrossings;
  auto swept = united(std::move(portions), left);
  if (!swept) return std::nullopt;
  const FlatLoops both[] = {loops, *std::move(swept)};
  if (!crossings_are_few(both, left)) return std::nullopt;
  FlatLoops result = distance > 0 ? wound(both) : combined(FlatOperation::kDifference, both);
  std::erase_if(result, [&](const FlatLoop& l) { return !is_more_than_rounding(l, distance); });
  return result;
}

}  // namespace

std::optional<FlatLoops> bounded_offset(const FlatLoops& loops, double distance, FlatJoin join,
                                        double arc_tolerance) {
  if (loops.empty() || distance == 0) return loops;
  auto portions = swept_portions(loops, distance, Joins(distance, join, arc_tolerance));
  if (!portions) return std::nullopt;
  std::size_t at_once = kMaxCrossingsAtOnce;
  if (crossings_are_few(*portions, at_once)) return offset(loops, distance, join, arc_tolerance);
  return with_swept(loops, distance, *std::move(portions));
}

std::optional<FlatLoops> swept_offset(const FlatLoops& loops, double distance, FlatJoin join,
                                      double arc_tolerance) {
  if (loops.empty() || distance == 0) return loops;
  auto portions = swept_portions(loops, distance, Joins(distance, join, arc_tolerance));
  if (!portions) return std::nullopt;
  return with_swept(loops, distance, *std::move(portions));
}

}  // namespace graycube
