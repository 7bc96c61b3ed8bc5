// Polygons of the plane, with holes: Boolean operations and offsets (by Clipper, which only
// polygon.cpp knows), and tests of what is in them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace graycube {

struct FlatPoint {
  double x = 0, y = 0;
  friend bool operator==(const FlatPoint&, const FlatPoint&) = default;
};
/// A closed cycle of corners; the last is joined to the first.
using FlatLoop = std::vector<FlatPoint>;
/// A figure: the points that an odd number of its loops goes round.
using FlatLoops = std::vector<FlatLoop>;

/// One connected part: an outline counter-clockwise, and holes clockwise.
struct FlatRegion {
  FlatLoop outline;
  FlatLoops holes;
};

/// p' = [a b; c d] p + (x, y), rows of three.
struct FlatMap {
  std::array<std::array<double, 3>, 2> m{{{1, 0, 0}, {0, 1, 0}}};

  FlatPoint operator()(const FlatPoint& p) const {
    return {m[0][0] * p.x + m[0][1] * p.y + m[0][2], m[1][0] * p.x + m[1][1] * p.y + m[1][2]};
  }
  double determinant() const { return m[0][0] * m[1][1] - m[0][1] * m[1][0]; }
  friend bool operator==(const FlatMap&, const FlatMap&) = default;
};
FlatMap compose(const FlatMap& then, const FlatMap& first);
FlatLoops mapped(const FlatMap& map, FlatLoops loops);

/// The sign of the area of the triangle a, b, c: positive where it turns left. Exact: the
/// error-free products of Shewchuk, "Adaptive Precision Floating-Point Arithmetic" (1997), where
/// rounding could tell.
int orientation(const FlatPoint& a, const FlatPoint& b, const FlatPoint& c);

/// Whether the point is within the loops, by the even-odd rule.
bool is_within(std::span<const FlatLoop> loops, const FlatPoint& p);

/// The smallest rectangle that holds all corners, lower corner first; there must be a loop.
std::array<FlatPoint, 2> flat_bounds(std::span<const FlatLoop> loops);

/// The corners of the convex hull, counter-clockwise, none of them on a line between others. Fewer
/// than three where the points lie in one line.
FlatLoop flat_hull(std::vector<FlatPoint> points);

/// Clipper works on integers: coordinates are rounded to 2^-40 of the largest one's power of two,
/// corners that stay keep their own values. All results are outlines counter-clockwise and holes
/// clockwise that touch one another at corners only. Coordinates must be finite. How long they take
/// depends on the sides that cross: crossings_are_few() tells in time. A figure of many corners
/// whose outlines meet nowhere is taken as it is, which is fast, with corners on straight lines.
inline constexpr std::size_t kManyFlatCorners = 4096;

enum class FlatOperation : std::uint8_t { kUnion, kIntersection, kDifference };
/// The operation on the first operand and all others together; each operand is even-odd.
FlatLoops combined(FlatOperation operation, std::span<const FlatLoops> operands);
/// Like combined() for one operand: outlines that cross themselves or one another are resolved.
FlatLoops resolved(const FlatLoops& loops);
/// The points round which the loops of all operands wind in sum. Corners of the result may touch.
FlatLoops wound(std::span<const FlatLoops> operands);
/// The connected parts.
std::vector<FlatRegion> regions_of(const FlatLoops& loops);
FlatLoops loops_of(std::vector<FlatRegion> regions);

/// Miters longer than so many distances are cut off.
inline constexpr double kFlatMiterLimit = 1e6;
enum class FlatJoin : std::uint8_t { kRound, kMiter, kSquare };
/// The figure grown by `distance` everywhere, or shrunk if it is negative. The facets of round
/// joins are at most `arc_tolerance` > 0 off the arc.
FlatLoops offset(const FlatLoops& loops, double distance, FlatJoin join, double arc_tolerance);

/// Like offset(), for fine outlines: corners of the result may touch, which offset() takes
/// quadratic time to separate. The given loops must not cross; outlines are counter-clockwise and
/// holes clockwise.
FlatLoops offset_simple(const FlatLoops& loops, double distance, FlatJoin join,
                        double arc_tolerance);
/// Whether `outer` holds all of `inner`; both are even-odd.
bool is_covered(const FlatLoops& inner, const FlatLoops& outer);
/// The number of loops once crossings are resolved.
std::size_t resolved_count(const FlatLoops& loops);

}  // namespace graycube
