#include "formats/openscad/hulls/mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

using Face = std::vector<std::uint32_t>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// A face narrower than this, relative to its length, has no normal.
constexpr double kLeastFaceWidth = 1e-12;

struct FacePlane {
  Vec3 normal;
  double offset = 0;
  /// Twice the face's area.
  double area = 0;
  /// How far a point may be off the plane because it was rounded when written; and how much more
  /// per distance from the face, since the plane turns as the face's own corners were rounded.
  double tolerance = 0, slack = 0;
  Vec3 center;
  std::size_t face = 0;
};

bool before(const Vec3& a, const Vec3& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

/// For every point the first in the list with the same coordinates; OpenSCAD joins these, too.
std::vector<std::uint32_t> representatives(const std::vector<Vec3>& points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return before(points[a], points[b]); });
  std::vector<std::uint32_t> result(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && points[order[i]] == points[order[i - 1]];
    result[order[i]] = same ? result[order[i - 1]] : order[i];
  }
  return result;
}

/// The faces with joined points, without faces that are left with fewer than three corners.
std::vector<Face> joined_faces(const ScadMesh& mesh) {
  const std::vector<std::uint32_t> joined = representatives(mesh.points);
  std::vector<Face> faces;
  for (const Face& face : mesh.faces) {
    Face kept;
    for (const std::uint32_t corner : face) {
      if (kept.empty() || kept.back() != joined[corner]) kept.push_back(joined[corner]);
    }
    while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
    if (kept.size() >= 3) faces.push_back(std::move(kept));
  }
  return faces;
}

/// A description of an edge that isn't shared by exactly two faces; empty when there is none.
std::string open_edge(const std::vector<Face>& faces) {
  std::vector<Edge> edges;
  for (const Face& face : faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      edges.push_back(std::minmax({face[i], face[(i + 1) % face.size()]}));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i;
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end - i != 2) {
      return "is not closed: the edge from point " + std::to_string(edges[i].first) + " to point " +
             std::to_string(edges[i].second) + " belongs to " + std::to_string(end - i) +
             " face(s), not 2";
    }
    i = end;
  }
  return {};
}

/// The plane of a face by Newell's sum, which weighs all corners alike; area 0 if the face has no
/// plane.
FacePlane plane_of(const std::vector<Vec3>& points, const Face& face, const Vec3& rounding) {
  FacePlane plane;
  const Vec3 origin = points[face[0]];
  Vec3 sum, mean;
  double longest = 0;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vec3 here = points[face[i]] - origin;
    const Vec3 there = points[face[(i + 1) % face.size()]] - origin;
    sum = sum + cross(here, there);
    mean = mean + here;
    longest = std::max(longest, std::max(length(there - here), length(here)));
  }
  plane.area = length(sum);
  if (!(plane.area > kLeastFaceWidth * longest * longest)) return FacePlane{};
  plane.normal = normalized(sum);
  for (int a = 0; a < 3; ++a) plane.tolerance += std::fabs(plane.normal[a]) * rounding[a];
  plane.center = origin + (1.0 / static_cast<double>(face.size())) * mean;
  plane.offset = dot(plane.normal, plane.center);
  plane.slack = plane.tolerance * longest / plane.area;
  return plane;
}

bool lies_in(const std::vector<Vec3>& points, const Face& face, const FacePlane& plane) {
  return std::all_of(face.begin(), face.end(), [&](std::uint32_t corner) {
    return std::fabs(dot(plane.normal, points[corner]) - plane.offset) <= plane.tolerance;
  });
}

/// How far points reach in front of a plane and behind it, and whether that is more than rounding
/// explains.
struct Excursion {
  double front = 0, back = 0;
  bool beyond_front = false, beyond_back = false;
};

Excursion excursion(const std::vector<Vec3>& points, std::span<const std::uint32_t> used,
                    const FacePlane& plane) {
  Excursion result;
  for (const std::uint32_t i : used) {
    const double distance = dot(plane.normal, points[i]) - plane.offset;
    const double allowed = plane.tolerance + plane.slack * length(points[i] - plane.center);
    result.front = std::max(result.front, distance);
    result.back = std::max(result.back, -distance);
    if (distance > allowed) result.beyond_front = true;
    if (distance < -allowed) result.beyond_back = true;
  }
  return result;
}

std::vector<std::uint32_t> used_points(const std::vector<Face>& faces) {
  std::vector<std::uint32_t> used;
  for (const Face& face : faces) used.insert(used.end(), face.begin(), face.end());
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  return used;
}

/// Planes of all faces that have one, the largest face first, as rounding turns its plane
/// least.
std::vector<FacePlane> face_planes(const std::vector<Vec3>& points, const std::vector<Face>& faces,
                                   double precision) {
  Vec3 rounding;
  for (const Face& face : faces) {
    for (const std::uint32_t i : face) {
      for (int a = 0; a < 3; ++a)
        rounding[a] = std::max(rounding[a], precision * std::fabs(points[i][a]));
    }
  }
  std::vector<FacePlane> planes;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    FacePlane plane = plane_of(points, faces[i], rounding);
    plane.face = i;
    if (plane.area > 0) planes.push_back(plane);
  }
  std::stable_sort(planes.begin(), planes.end(),
                   [](const FacePlane& a, const FacePlane& b) { return a.area > b.area; });
  return planes;
}

/// Turns the plane outwards and moves it to the outermost point, so that it cuts nothing off.
void settle(FacePlane& plane, bool turn, const std::vector<Vec3>& points,
            std::span<const std::uint32_t> used) {
  if (turn) plane.normal = -plane.normal;
  plane.offset = dot(plane.normal, points[used[0]]);
  for (const std::uint32_t i : used)
    plane.offset = std::max(plane.offset, dot(plane.normal, points[i]));
}

}  // namespace

ConvexPlanes convex_planes(const ScadMesh& mesh, double precision) {
  const std::vector<Face> faces = joined_faces(mesh);
  if (faces.empty()) return {.planes = {}, .problem = {}, .flat = true};
  if (std::string edge = open_edge(faces); !edge.empty()) return {{}, std::move(edge), false};
  const std::vector<std::uint32_t> used = used_points(faces);

  std::vector<FacePlane> kept;
  for (FacePlane& plane : face_planes(mesh.points, faces, precision)) {
    const Face& face = faces[plane.face];
    if (!lies_in(mesh.points, face, plane)) {
      return {{}, "has a face that is not flat", false};
    }
    const Excursion reach = excursion(mesh.points, used, plane);
    if (reach.beyond_back && reach.beyond_front) {
      return {{}, "is not convex", false};
    }
    if (kept.empty() && std::max(reach.front, reach.back) <= plane.tolerance) {
      return {.planes = {}, .problem = {}, .flat = true};
    }
    // A sliver's direction is hidden by its corners' rounding, but its plane cuts nothing off.
    settle(plane, reach.front > reach.back, mesh.points, used);
    const bool merged = std::any_of(kept.begin(), kept.end(), [&](const FacePlane& other) {
      return dot(other.normal, plane.normal) > 0 && lies_in(mesh.points, face, other);
    });
    if (merged) continue;
    kept.push_back(plane);
  }
  if (kept.size() < 4) return {.planes = {}, .problem = {}, .flat = true};
  ConvexPlanes result;
  for (const FacePlane& plane : kept) {
    // Adding +0 turns −0 into +0.
    const Vec3 n = plane.normal + Vec3{};
    result.planes.push_back({n, plane.offset + 0.0});
  }
  return result;
}

namespace {

/// Rings of `sides` corners each, joined by quadrilaterals; polygons close the first and the
/// last.
ScadMesh stacked_rings(std::span<const std::pair<double, double>> radius_and_height, int sides) {
  ScadMesh mesh;
  const auto n = static_cast<std::uint32_t>(sides);
  for (const auto& [radius, height] : radius_and_height) {
    for (int i = 0; i < sides; ++i) {
      const double angle = 360.0 * i / sides;
      mesh.points.push_back({radius * cos_degrees(angle), radius * sin_degrees(angle), height});
    }
  }
  const auto rings = static_cast<std::uint32_t>(radius_and_height.size());
  std::vector<std::uint32_t> cap(n);
  std::iota(cap.begin(), cap.end(), 0u);
  mesh.faces.push_back(cap);
  std::iota(cap.begin(), cap.end(), (rings - 1) * n);
  mesh.faces.push_back(cap);
  for (std::uint32_t ring = 0; ring + 1 < rings; ++ring) {
    const std::uint32_t low = ring * n, high = low + n;
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t next = (i + 1) % n;
      mesh.faces.push_back({low + i, low + next, high + next, high + i});
    }
  }
  return mesh;
}

}  // namespace

std::vector<Vec3> used_points(const ScadMesh& mesh) {
  std::vector<bool> is_used(mesh.points.size());
  std::vector<Vec3> used;
  for (const Face& face : mesh.faces) {
    for (const std::uint32_t i : face) {
      if (!is_used[i]) used.push_back(mesh.points[i]);
      is_used[i] = true;
    }
  }
  return used;
}

PolygonMesh polygons_of(const ScadMesh& mesh) {
  PolygonMesh polygons;
  polygons.points = mesh.points;
  for (const auto& face : mesh.faces) polygons.add_face(face);
  return polygons;
}

ScadMesh faceted_cylinder(double z_low, double z_high, double r_low, double r_high, int sides) {
  const std::array<std::pair<double, double>, 2> rings{{{r_low, z_low}, {r_high, z_high}}};
  return stacked_rings(rings, sides);
}

ScadMesh faceted_sphere(double radius, int sides) {
  const int count = (sides + 1) / 2;
  std::vector<std::pair<double, double>> rings;
  for (int i = 0; i < count; ++i) {
    const double polar = 180.0 * (i + 0.5) / count;
    rings.emplace_back(radius * sin_degrees(polar), radius * cos_degrees(polar));
  }
  return stacked_rings(rings, sides);
}

}  // namespace graycube
