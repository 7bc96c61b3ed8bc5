#include "formats/openscad/hulls/ring_sums.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

using Kind = RoundRing::Kind;

double radius_of(const RoundRing& ring) { return length(ring.corners[0] - ring.center); }

/// Corners as seen from the centre along a direction, counter-clockwise about it.
std::vector<Vec3> spokes_of(const RoundRing& ring, const Vec3& along) {
  std::vector<Vec3> spokes;
  for (const Vec3& corner : ring.corners) spokes.push_back(across(corner - ring.center, along));
  Vec3 turn;
  for (std::size_t i = 0; i < spokes.size(); ++i)
    turn = turn + cross(spokes[i], spokes[(i + 1) % spokes.size()]);
  if (dot(turn, along) < 0) std::reverse(spokes.begin(), spokes.end());
  return spokes;
}

/// The corners of the sum of two convex polygons that are counter-clockwise about a direction:
/// their sides one after the other, by their directions. Parallel sides become one.
std::vector<Vec3> sum_of_spokes(std::vector<Vec3> a, std::vector<Vec3> b, const Vec3& along,
                                double share) {
  // Both begin at the corner that lies farthest along −e, so their sides turn from there.
  const Vec3 e = normalized(a[0]);
  const auto farthest = [&](std::vector<Vec3>& spokes) {
    const auto before = [&](const Vec3& p, const Vec3& q) {
      const double x = dot(p, e), y = dot(q, e);
      if (std::fabs(x - y) > share * length(p)) return x < y;
      return dot(cross(e, p), along) > dot(cross(e, q), along);
    };
    std::rotate(spokes.begin(), std::min_element(spokes.begin(), spokes.end(), before),
                spokes.end());
  };
  farthest(a);
  farthest(b);
  std::vector<Vec3> sum;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    sum.push_back(a[i % a.size()] + b[j % b.size()]);
    const Vec3 p = a[(i + 1) % a.size()] - a[i % a.size()],
               q = b[(j + 1) % b.size()] - b[j % b.size()];
    const double turn = dot(cross(p, q), along), parallel = share * length(p) * length(q);
    const bool is_a_left = i < a.size(), is_b_left = j < b.size();
    // Negated, so that numbers beyond doubles' range end the loop as well.
    if (is_a_left && (!is_b_left || !(turn < -parallel))) ++i;
    if (is_b_left && (!is_a_left || !(turn > parallel))) ++j;
  }
  return sum;
}

/// The polar angles of the rings of corners on OpenSCAD's balls, none of which need be an equator.
std::vector<double> polar_angles(const RoundRing& ball) {
  const std::size_t rings = (ball.corners.size() + 1) / 2;
  std::vector<double> angles;
  for (std::size_t i = 0; i < rings; ++i)
    angles.push_back(180 * (static_cast<double>(i) + 0.5) / static_cast<double>(rings));
  return angles;
}

/// The solid with the corners around it where it is widest: OpenSCAD's balls have less than their
/// radius there.
RoundRing waist_of(RoundRing ring) {
  if (ring.kind != Kind::kBall) return ring;
  const std::vector<double> angles = polar_angles(ring);
  const double widest = sin_degrees(angles[angles.size() / 2]);
  for (Vec3& corner : ring.corners) corner = ring.center + widest * (corner - ring.center);
  return ring;
}

bool are_parallel(const Vec3& a, const Vec3& b, double share) {
  const Vec3 p = normalized(a), q = normalized(b);
  return max_abs(p - q) <= share || max_abs(p + q) <= share;
}

/// Whether both have corners in the same directions from their centres.
bool have_like_corners(const RoundRing& a, const RoundRing& b, double share) {
  if (a.corners.size() != b.corners.size()) return false;
  const double ratio = radius_of(a) / radius_of(b);
  return std::all_of(b.corners.begin(), b.corners.end(), [&](const Vec3& corner) {
    const Vec3 spoke = ratio * (corner - b.center);
    return std::any_of(a.corners.begin(), a.corners.end(), [&](const Vec3& own) {
      return max_abs(own - a.center - spoke) <= share * (radius_of(a) + max_abs(a.center));
    });
  });
}

/// The rim that a ball makes around the wide end of a cone, with the same corners; `by`: where the
/// ball is.
RoundRing rim_of(const RoundRing& cone, const RoundRing& ball, const Vec3& by) {
  const double wide = radius_of(cone), more = radius_of(ball);
  RoundRing rim;
  rim.kind = Kind::kTurned;
  rim.center = cone.center + by;
  rim.along = ball.along;
  for (const Vec3& corner : cone.corners)
    rim.corners.push_back(rim.center + (1 + more / wide) * (corner - cone.center));
  for (const double angle : polar_angles(ball))
    rim.profile.push_back({(wide + more * sin_degrees(angle)) / (wide + more), cos_degrees(angle)});
  return rim;
}

}  // namespace

RoundRing moved(RoundRing ring, const Vec3& by) {
  const Vec3 step = ring.kind == Kind::kCylinder ? across(by, ring.along) : by;
  ring.center = ring.center + step;
  for (Vec3& corner : ring.corners) corner = corner + step;
  return ring;
}

namespace {

/// `by`: where the second ball is.
std::optional<RoundRing> sum_of_balls(const RoundRing& a, const RoundRing& b, const Vec3& by,
                                      double share) {
  const double more = radius_of(b) / radius_of(a), off = share * length(b.along);
  const bool is_alike =
      max_abs(b.along - more * a.along) <= off || max_abs(b.along + more * a.along) <= off;
  if (!is_alike || !have_like_corners(a, b, share)) return std::nullopt;
  RoundRing sum = moved(a, by);
  for (Vec3& corner : sum.corners) corner = corner + more * (corner - sum.center);
  sum.along = (1 + more) * a.along;
  return sum;
}

}  // namespace

std::optional<RoundRing> sum_of(const RoundRing& a, const RoundRing& b, const Vec3& origin,
                                double share) {
  if (a.is_open || b.is_open || a.corners.size() < 3 || b.corners.size() < 3) return std::nullopt;
  if (a.kind != Kind::kCylinder && b.kind == Kind::kCylinder) return sum_of(b, a, origin, share);
  if (a.kind == Kind::kBall && b.kind == Kind::kCone) return sum_of(b, a, origin, share);
  const Vec3 by = b.center - origin;
  if (a.kind == Kind::kCone && b.kind == Kind::kBall) {
    if (!are_parallel(a.along, b.along, share) || !have_like_corners(a, b, share))
      return std::nullopt;
    return rim_of(a, b, by);
  }
  if (a.kind == Kind::kBall && b.kind == Kind::kBall) return sum_of_balls(a, b, by, share);
  if (a.kind != Kind::kCylinder || b.kind == Kind::kTurned ||
      !are_parallel(a.along, b.along, share))
    return std::nullopt;
  const RoundRing waist = waist_of(b);
  RoundRing sum = moved(a, by);
  sum.corners.clear();
  for (const Vec3& spoke :
       sum_of_spokes(spokes_of(a, a.along), spokes_of(waist, a.along), a.along, share))
    sum.corners.push_back(sum.center + spoke);
  return sum;
}

std::size_t SumOperand::size() const {
  std::size_t size = corners.size();
  for (const RoundRing& ring : rings) size += ring.corners.size() + ring.profile.size();
  return size;
}

bool add_to_sum(SumOperand& sum, const SumOperand& operand, const Vec3& origin, double share) {
  if (sum.size() * operand.size() > kMostSumCorners) return false;
  SumOperand next;
  const auto add_moved = [&](const SumOperand& round, const SumOperand& straight) {
    for (const RoundRing& ring : round.rings) {
      for (const Vec3& corner : straight.corners)
        next.rings.push_back(moved(ring, corner - origin));
    }
  };
  add_moved(sum, operand);
  add_moved(operand, sum);
  for (const RoundRing& a : sum.rings) {
    for (const RoundRing& b : operand.rings) {
      if (auto both = sum_of(a, b, origin, share)) next.rings.push_back(*std::move(both));
    }
  }
  for (const Vec3& a : sum.corners) {
    for (const Vec3& b : operand.corners) next.corners.push_back(a + b - origin);
  }
  sum = std::move(next);
  return true;
}

}  // namespace graycube
