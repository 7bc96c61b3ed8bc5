#include "formats/openscad/hulls/facet_edges.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/aabb.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

/// Corners may be off by this share of an edge at most, else nothing is told by them.
constexpr double kMostOff = 0.1;
/// More than 1: what touches counts as near, whatever its digits.
constexpr double kNear = 1.01;
constexpr std::uint32_t kNoCorner = UINT32_MAX;

/// The corners on a ring's edge lines, sorted by x, with their places in one row of all lines.
class Corners {
 public:
  /// `share`: how far coordinates may be off relative to their size, beyond `off`.
  Corners(const RoundRing& ring, double off, double share) : ring_(ring), share_(share) {
    auto lines = edge_lines(ring);
    for (const auto& line : lines) {
      for (const Vec3& p : line) reach_ = std::max(reach_, length(p - ring.center));
    }
    off_ = off + share * (max_abs(ring.center) + reach_);
    std::erase_if(lines, [&](const auto& line) { return !are_told_apart(line); });
    for (const auto& line : lines) {
      for (const Vec3& p : line)
        corners_.emplace_back(p, static_cast<std::uint32_t>(corners_.size()));
    }
    std::sort(corners_.begin(), corners_.end(),
              [](const auto& a, const auto& b) { return a.first.x < b.first.x; });
  }
  bool empty() const { return corners_.empty(); }
  /// The corner at a point as the ring sees it, and its place; null if there is none.
  const std::pair<Vec3, std::uint32_t>* at(const SeenPoint& point) const {
    const Vec3& p = point.place;
    const double off = off_at(point);
    if (!(length(p - ring_.center) <= reach_ + off)) return nullptr;
    auto near = std::lower_bound(corners_.begin(), corners_.end(), p.x - off,
                                 [](const auto& corner, double x) { return corner.first.x < x; });
    for (; near != corners_.end() && near->first.x <= p.x + off; ++near) {
      if (max_abs(near->first - p) <= off) return &*near;
    }
    return nullptr;
  }

 private:
  bool are_told_apart(const std::vector<Vec3>& line) {
    if (line.size() < (ring_.is_open ? 2 : 3) || !std::all_of(line.begin(), line.end(), is_finite))
      return false;
    const double most = kMostOff * length(line[1] - line[0]);
    if (!(off_ < most)) return false;
    most_off_ = std::min(most_off_, most);
    return true;
  }
  /// How far a point may be off, more away from a cone's end and near its tip; NaN where nothing is
  /// told.
  double off_at(const SeenPoint& point) const {
    if (ring_.kind != RoundRing::Kind::kCone) return off_;
    const double beyond = share_ * std::fabs(point.height) * (length(ring_.along) + reach_);
    const double off = (off_ + beyond) / point.size;
    return point.size > 0 && off < most_off_ ? off : std::numeric_limits<double>::quiet_NaN();
  }

  const RoundRing& ring_;
  double share_, off_ = 0, reach_ = 0, most_off_ = std::numeric_limits<double>::infinity();
  std::vector<std::pair<Vec3, std::uint32_t>> corners_;
};

/// Whether two corners are neighbours on one line of `count` corners.
bool are_neighbours(std::uint32_t a, std::uint32_t b, std::uint32_t count, bool is_open) {
  if (a == kNoCorner || b == kNoCorner || a / count != b / count) return false;
  const std::uint32_t apart = a < b ? b - a : a - b;
  return apart == 1 || (!is_open && apart == count - 1);
}

/// How far it is from `middle` to what a ring goes around, and how far that reaches there, within
/// `reach` of it.
std::pair<double, double> distance_and_reach(const RoundRing& ring, const Vec3& middle,
                                             double reach) {
  double radius = 0;
  for (const Vec3& p : ring.corners) radius = std::max(radius, length(p - ring.center));
  if (ring.kind == RoundRing::Kind::kCylinder)
    return {length(across(middle, ring.along) - ring.center), radius};
  if (ring.kind == RoundRing::Kind::kCone) {
    const Vec3 away = middle - ring.center;
    const double height = dot(ring.normal, away), most = reach * length(ring.normal);
    const double size = 1 + ring.narrowing * (std::fabs(height) + most);
    return {length(away - height * ring.along), size * radius + most * length(ring.along)};
  }
  return {length(ring.center - middle), std::max(radius, length(ring.along))};
}

}  // namespace

FacetEdges::FacetEdges(const PolygonMesh& mesh, const Affine& to_world) {
  double largest = 0, stretch = 0;
  for (const Vec3& p : mesh.points) {
    largest = std::max(largest, max_abs(p));
    points_.push_back(to_world.point(p));
  }
  for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    stretch += max_abs(to_world.vector(axis));
  off_ = kHalfOfSixDigits * largest * stretch;
  std::size_t begin = 0;
  for (const std::size_t end : mesh.face_ends) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t a = mesh.corners[i], b = mesh.corners[i + 1 < end ? i + 1 : begin];
      if (a < points_.size() && b < points_.size()) edges_.emplace_back(a, b);
    }
    begin = end;
  }
  find_reach();
}

FacetEdges::FacetEdges(const FlatLoops& outlines, const Affine& to_world)
    : only_(RoundRing::Kind::kCylinder) {
  for (const FlatLoop& loop : outlines) {
    const auto first = static_cast<std::uint32_t>(points_.size());
    const auto count = static_cast<std::uint32_t>(loop.size());
    for (std::uint32_t i = 0; i < count; ++i) {
      points_.push_back(to_world.point({loop[i].x, loop[i].y, 0}));
      edges_.emplace_back(first + i, first + (i + 1) % count);
    }
  }
  find_reach();
  off_ = kHalfOfSixDigits * (max_abs(middle_) + reach_);
}

FacetEdges::FacetEdges(const FlatLoops& outlines, const RingAngles& angles, const Affine& to_world)
    : only_(RoundRing::Kind::kTurned) {
  const auto count = static_cast<std::uint32_t>(angles.degrees.size());
  for (const FlatLoop& loop : outlines) {
    for (const FlatPoint& p : loop) {
      const auto first = static_cast<std::uint32_t>(points_.size());
      for (const double angle : angles.degrees)
        points_.push_back(
            to_world.point({p.x * cos_degrees(angle), p.x * sin_degrees(angle), p.y}));
      for (std::uint32_t i = angles.is_open ? 1 : 0; i < count; ++i)
        edges_.emplace_back(first + (i + count - 1) % count, first + i);
    }
  }
  find_reach();
  off_ = kHalfOfSixDigits * (max_abs(middle_) + reach_);
}

void FacetEdges::find_reach() {
  Aabb box = Aabb::nothing();
  for (const Vec3& p : points_) box.include(p);
  if (box.is_empty()) return;
  middle_ = box.center();
  reach_ = length(box.hi - middle_) + off_;
}

bool FacetEdges::are_near(const RoundRing& ring) const {
  if (only_ && ring.kind != *only_) return false;
  const auto [distance, reach] = distance_and_reach(ring, middle_, reach_);
  return distance <= kNear * (reach + reach_);
}

bool FacetEdges::have_one_of(const RoundRing& ring, double share) const {
  const Corners corners(ring, off_, share);
  if (corners.empty()) return false;
  std::vector<std::uint32_t> places(points_.size(), kNoCorner);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (const auto* corner = corners.at(seen_by(ring, points_[i]))) places[i] = corner->second;
  }
  const auto count = static_cast<std::uint32_t>(ring.corners.size());
  return std::any_of(edges_.begin(), edges_.end(), [&](const auto& edge) {
    return are_neighbours(places[edge.first], places[edge.second], count, ring.is_open);
  });
}

void move_to_corners(const RoundRing& ring, double off, std::vector<Vec3>& points) {
  const Corners corners(ring, off, 0);
  if (corners.empty()) return;
  for (Vec3& p : points) {
    const SeenPoint seen = seen_by(ring, p);
    if (const auto* corner = corners.at(seen)) p = p + seen.size * (corner->first - seen.place);
  }
}

}  // namespace graycube
