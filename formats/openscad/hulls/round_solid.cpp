#include "formats/openscad/hulls/round_solid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "formats/openscad/hulls/convex_hull.hpp"

namespace graycube {
namespace {

/// Corners within this distance lie in a plane, relative to the extent of all.
constexpr double kOnPlane = 1e-9;
/// Triangles narrower than this, relative to their length, have no normal.
constexpr double kLeastWidth = 1e-9;

CsgNode leaf(decltype(CsgNode::value) value) {
  return {std::move(value), std::nullopt, kInheritMaterial};
}

/// The solid between two balls, from circle to circle where the common tangent cone touches them.
CsgNode bridge_of_balls(const RoundPoint& a, const RoundPoint& b) {
  if (a.radius == b.radius) return leaf(CylinderShape{a.center, b.center, a.radius});
  const Vec3 d = b.center - a.center;
  const double distance = length(d), cosine = (a.radius - b.radius) / distance;
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  const Vec3 shift = (cosine / distance) * d;
  return leaf(ConeShape{a.center + a.radius * shift, a.radius * sine, b.center + b.radius * shift,
                        b.radius * sine});
}

/// The solid between two discs at different heights: every level section is a disc between the two,
/// so this is an upright cone, slanted.
CsgNode bridge_of_discs(const RoundPoint& a, const RoundPoint& b) {
  const RoundPoint &low = a.center.z < b.center.z ? a : b, &high = a.center.z < b.center.z ? b : a;
  const Vec3 base = low.center, top{base.x, base.y, high.center.z};
  CsgNode node = low.radius == high.radius ? leaf(CylinderShape{base, top, low.radius})
                                           : leaf(ConeShape{base, low.radius, top, high.radius});
  const double height = top.z - base.z;
  const double x = (high.center.x - base.x) / height, y = (high.center.y - base.y) / height;
  if (x != 0 || y != 0) {
    node.transform = Affine{{{{1, 0, x, -x * base.z}, {0, 1, y, -y * base.z}, {0, 0, 1, 0}}}};
  }
  return node;
}

double extent_of(const std::vector<Vec3>& points) {
  double extent = 0;
  for (const Vec3& p : points) extent = std::max(extent, max_abs(p - points.front()));
  return extent;
}

/// The half-spaces of a hull: the planes that are known, and those of the triangles that lie in
/// none of them.
std::vector<HalfSpaceShape> planes_of(const ScadMesh& hull, std::vector<HalfSpaceShape> planes) {
  const double tolerance = kOnPlane * extent_of(hull.points);
  Vec3 middle;
  for (const Vec3& p : hull.points)
    middle = middle + (1.0 / static_cast<double>(hull.points.size())) * p;
  for (const auto& face : hull.faces) {
    const Vec3 &a = hull.points[face[0]], &b = hull.points[face[1]], &c = hull.points[face[2]];
    const auto holds_all = [&](const HalfSpaceShape& plane) {
      return std::max({std::fabs(dot(plane.normal, a) - plane.offset),
                       std::fabs(dot(plane.normal, b) - plane.offset),
                       std::fabs(dot(plane.normal, c) - plane.offset)}) <= tolerance;
    };
    if (std::any_of(planes.begin(), planes.end(), holds_all)) continue;
    const Vec3 normal = cross(b - a, c - a);
    const double longest = std::max({length(b - a), length(c - a), length(c - b)});
    if (!(length(normal) > kLeastWidth * longest * longest)) continue;
    HalfSpaceShape plane{normalized(normal), 0};
    if (dot(plane.normal, a - middle) < 0) plane.normal = -plane.normal;
    plane.normal = plane.normal + Vec3{};
    // The plane goes through the outermost point, so that it cuts nothing off.
    plane.offset = dot(plane.normal, a);
    for (const Vec3& p : hull.points) plane.offset = std::max(plane.offset, dot(plane.normal, p));
    plane.offset += 0.0;
    planes.push_back(plane);
  }
  return planes;
}

/// The polyhedron of the planes; a box if they are those of a box.
CsgNode polyhedron(std::vector<HalfSpaceShape> planes) {
  BoxShape box;
  int sides = 0;
  for (const HalfSpaceShape& plane : planes) {
    for (int a = 0; a < 3; ++a) {
      if (plane.normal[a] == 1) box.max[a] = plane.offset, ++sides;
      if (plane.normal[a] == -1) box.min[a] = -plane.offset + 0.0, ++sides;
    }
  }
  if (sides == 6 && planes.size() == 6) return leaf(box);
  return leaf(PolyhedronShape{std::move(planes)});
}

/// Adds balls' centres: if radii differ, they may lie beyond the hull of the points that planes
/// touch.
void add_centers_outside(const RoundHull& hull, std::vector<Vec3>& core) {
  const ScadMesh mesh = convex_hull(core);
  const double tolerance = kOnPlane * extent_of(core);
  const auto planes = mesh.faces.empty() ? std::vector<HalfSpaceShape>{} : planes_of(mesh, {});
  for (const RoundPoint& p : hull.points) {
    const bool is_inside =
        !planes.empty() && std::all_of(planes.begin(), planes.end(), [&](const HalfSpaceShape& s) {
          return dot(s.normal, p.center) <= s.offset + tolerance;
        });
    if (!is_inside) core.push_back(p.center);
  }
}

std::optional<RoundSolid> core_of(const RoundHull& hull) {
  std::vector<Vec3> corners = hull.core;
  const auto is_alike = [&](const RoundPoint& p) { return p.radius == hull.points.front().radius; };
  const bool is_even = std::all_of(hull.points.begin(), hull.points.end(), is_alike);
  if (!is_even && !hull.planes.empty()) add_centers_outside(hull, corners);
  const auto before = [](const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  std::sort(corners.begin(), corners.end(), before);
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  const ScadMesh mesh = convex_hull(corners);
  if (mesh.faces.empty()) return std::nullopt;
  std::vector<HalfSpaceShape> planes = planes_of(mesh, hull.planes);
  if (planes.size() < 4) return std::nullopt;
  if (planes.size() <= kMaxPolyhedronFaces)
    return RoundSolid{polyhedron(std::move(planes)), std::move(corners)};
  auto closed = closed_mesh(polygons_of(mesh));
  if (!std::holds_alternative<TriangleMesh>(closed)) return std::nullopt;
  return RoundSolid{leaf(MeshShape{std::get<TriangleMesh>(std::move(closed))}), std::move(corners)};
}

}  // namespace

std::optional<RoundSolid> round_solid(RoundKind kind, std::vector<RoundPoint> points,
                                      bool& is_too_large) {
  const auto hull = round_hull(kind, std::move(points));
  is_too_large = !hull;
  if (!hull) return std::nullopt;
  RoundSolid solid;
  std::vector<CsgNode> pieces;
  if (auto core = core_of(*hull)) {
    pieces.push_back(std::move(core->node));
    solid.corners = std::move(core->corners);
  }
  for (const auto& [a, b] : hull->bridges) {
    const RoundPoint &p = hull->points[a], &q = hull->points[b];
    pieces.push_back(kind == RoundKind::kBalls ? bridge_of_balls(p, q) : bridge_of_discs(p, q));
  }
  for (const std::size_t i : hull->corners)
    pieces.push_back(leaf(SphereShape{hull->points[i].center, hull->points[i].radius}));
  if (pieces.empty()) return std::nullopt;
  solid.node = pieces.size() == 1 ? std::move(pieces.front())
                                  : leaf(OperationNode{Operation::kUnion, std::move(pieces)});
  return solid;
}

}  // namespace graycube
