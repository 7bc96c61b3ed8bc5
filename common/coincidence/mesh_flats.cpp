#include "coincidence/mesh_flats.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/edges.hpp"

namespace graycube::csg {
namespace {

using Corners = std::array<Vec3, 3>;

Vec3 twice_area(const Corners& c) { return cross(c[1] - c[0], c[2] - c[0]); }
/// The least height of a triangle; 0 if it has no area.
double least_height(const Corners& c) {
  const double longest =
      std::max(length(c[1] - c[0]), std::max(length(c[2] - c[1]), length(c[0] - c[2])));
  const double height = length(twice_area(c)) / longest;
  return height > 0 ? height : 0;
}

/// The widest triangle found so far between the corners of a flat part; it gives the part's plane.
class WidestTriangle {
 public:
  explicit WidestTriangle(const Corners& corners)
      : corners_(corners), width_(least_height(corners)) {
    measure();
  }

  /// Whether a point that may be off by `distance`, like the corners, may be in their plane: it is
  /// a weighted sum of the corners, and so its error is one of theirs.
  bool may_hold(const Vec3& p, double distance) const {
    const auto& [a, b, c] = corners_;
    const double u = dot(normal_, cross(c - b, p - b)) / area_,
                 v = dot(normal_, cross(a - c, p - c)) / area_;
    const double errors = 1 + std::fabs(u) + std::fabs(v) + std::fabs(1 - u - v);
    return std::fabs(dot(normal_, p - a)) <= distance * errors;
  }
  void widen(const Vec3& p) {
    // Smaller gains aren't taken: they could take as many steps as there are corners.
    constexpr double kWorthIt = 1.0625;
    Corners best = corners_;
    double width = kWorthIt * width_;
    for (std::size_t i = 0; i < 3; ++i) {
      Corners with = corners_;
      with[i] = p;
      const double height = least_height(with);
      if (!(height > width)) continue;
      width = height;
      best = with;
    }
    if (best == corners_) return;
    if (dot(twice_area(best), normal_) < 0) std::swap(best[1], best[2]);
    corners_ = best;
    width_ = width;
    measure();
  }

  const Vec3& normal() const { return normal_; }
  Flat flat() const {
    Flat f;
    f.plane.normal = normal_ + Vec3{};
    f.plane.offset = dot(f.plane.normal, corners_[0]) + 0.0;
    f.middle = (1.0 / 3) * (corners_[0] + corners_[1] + corners_[2]);
    f.width = width_;
    return f;
  }

 private:
  void measure() {
    const Vec3 n = twice_area(corners_);
    area_ = length(n);
    normal_ = normalized(n);
  }

  Corners corners_;
  double width_;
  Vec3 normal_;
  double area_ = 0;
};

/// Grows flat parts from triangle to triangle, the widest first. Triangles are numbered by their
/// places in the list.
class Grower {
 public:
  Grower(const TriangleMesh& mesh, std::span<const std::uint32_t> list, double distance)
      : mesh_(mesh), distance_(distance), is_taken_(list.size()) {
    triangles_.reserve(list.size());
    for (const std::uint32_t i : list) triangles_.push_back(mesh.triangles[i]);
    across_ = sides_across(triangles_, kNone);
    heights_.reserve(list.size());
    for (const Triangle& t : triangles_) heights_.push_back(least_height(corners_of(t)));
  }

  std::vector<std::uint32_t> widest_first() const {
    std::vector<std::uint32_t> order(triangles_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return heights_[a] != heights_[b] ? heights_[a] > heights_[b] : a < b;
    });
    return order;
  }
  bool is_taken(std::uint32_t place) const { return is_taken_[place] != 0; }

  /// Appends the places of the triangles around `seed` that are in its plane.
  Flat grow(std::uint32_t seed, std::vector<std::uint32_t>& places) {
    const std::size_t first = places.size();
    WidestTriangle widest(corners_of(triangles_[seed]));
    take(seed, places);
    for (std::size_t i = first; i < places.size(); ++i) {
      for (std::uint32_t side = 0; side < 3; ++side) {
        const std::uint32_t other = across_[3 * places[i] + side];
        if (other == kNone || is_taken_[other / 3] != 0) continue;
        const Triangle& t = triangles_[other / 3];
        const Vec3& corner = mesh_.points[t[(other + 2) % 3]];
        if (!widest.may_hold(corner, distance_) || looks_back(other / 3, widest.normal())) continue;
        widest.widen(corner);
        take(other / 3, places);
      }
    }
    Flat f = widest.flat();
    f.first = static_cast<std::uint32_t>(first);
    f.count = static_cast<std::uint32_t>(places.size() - first);
    return f;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  Corners corners_of(const Triangle& t) const {
    return {mesh_.points[t[0]], mesh_.points[t[1]], mesh_.points[t[2]]};
  }
  /// Whether the triangle belongs to the other side of a sheet, which may be however thin.
  bool looks_back(std::uint32_t place, const Vec3& normal) const {
    constexpr double kSurelyWide = 4;
    return heights_[place] > kSurelyWide * distance_ &&
           dot(twice_area(corners_of(triangles_[place])), normal) < 0;
  }
  void take(std::uint32_t place, std::vector<std::uint32_t>& places) {
    is_taken_[place] = 1;
    places.push_back(place);
  }

  const TriangleMesh& mesh_;
  double distance_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> across_;
  std::vector<double> heights_;
  std::vector<std::uint8_t> is_taken_;
};

}  // namespace

MeshFlats::MeshFlats(const TriangleMesh& mesh, std::vector<std::uint32_t> triangles,
                     double distance) {
  Grower grower(mesh, triangles, distance);
  triangles_.reserve(triangles.size());
  for (const std::uint32_t seed : grower.widest_first()) {
    if (!grower.is_taken(seed)) flats_.push_back(grower.grow(seed, triangles_));
  }
  for (std::uint32_t& t : triangles_) t = triangles[t];
}

}  // namespace graycube::csg
