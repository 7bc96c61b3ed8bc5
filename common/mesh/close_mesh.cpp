#include "mesh/close_mesh.hpp"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

#include "mesh/cut_face.hpp"
#include "mesh/edges.hpp"
#include "mesh/face_limits.hpp"
#include "mesh/join_points.hpp"
#include "stop_point.hpp"
#include "stoppable_sort.hpp"
#include "written_digits.hpp"

namespace graycube {
namespace {

constexpr std::uint32_t kNoPoint = std::numeric_limits<std::uint32_t>::max();

std::string counted(std::size_t count, const char* singular, const char* plural) {
  return std::to_string(count) + " " + (count == 1 ? singular : plural);
}

/// Numbers points by their coordinates' bits, in the order in which they are first asked for.
class Welder {
 public:
  explicit Welder(std::span<const Vec3> points)
      : points_(points),
        slots_(std::bit_ceil(2 * points.size() + 1), kNoPoint),
        index_(points.size(), kNoPoint) {}

  std::uint32_t operator[](std::uint32_t i) {
    if (index_[i] != kNoPoint) return index_[i];
    const Vec3 p = points_[i] + Vec3{0, 0, 0};  // −0 becomes +0
    std::size_t slot = hash(p) & (slots_.size() - 1);
    while (slots_[slot] != kNoPoint && !(welded_[slots_[slot]] == p))
      slot = (slot + 1) & (slots_.size() - 1);
    if (slots_[slot] == kNoPoint) {
      slots_[slot] = static_cast<std::uint32_t>(welded_.size());
      welded_.push_back(p);
    }
    return index_[i] = slots_[slot];
  }
  std::vector<Vec3> take() { return std::move(welded_); }

 private:
  static std::size_t hash(const Vec3& p) {
    std::uint64_t h = 0;
    for (int a = 0; a < 3; ++a) {
      h = (h ^ std::bit_cast<std::uint64_t>(p[a])) * 0x9E3779B97F4A7C15u;
      h ^= h >> 29;
    }
    return static_cast<std::size_t>(h);
  }

  std::span<const Vec3> points_;
  std::vector<std::uint32_t> slots_, index_;
  std::vector<Vec3> welded_;
};

std::optional<MeshFault> fault_of_points(std::span<const Vec3> points) {
  if (points.size() > kMaxMeshPoints) {
    return MeshFault{"at most " + std::to_string(kMaxMeshPoints) + " points are accepted, found " +
                     std::to_string(points.size())};
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_finite(points[i])) return MeshFault{"point " + std::to_string(i) + " is not finite"};
  }
  return std::nullopt;
}

MeshFault too_many_triangles(std::size_t found) {
  return {"at most " + std::to_string(kMaxMeshTriangles) + " triangles are accepted, found " +
          std::to_string(found)};
}

std::optional<MeshFault> fault_of_faces(const PolygonMesh& p) {
  std::uint32_t begin = 0;
  std::size_t triangles = 0;
  for (std::size_t f = 0; f < p.face_ends.size(); ++f) {
    const std::uint32_t end = p.face_ends[f], n = end - begin;
    const auto where = [f] { return "face " + std::to_string(f) + " has "; };
    if (n < 3)
      return MeshFault{where() + counted(n, "corner", "corners") + ", at least 3 are needed"};
    if (n > kMostFaceCorners) {
      return MeshFault{where() + std::to_string(n) + " corners, at most " +
                       std::to_string(kMostFaceCorners) + " are accepted"};
    }
    for (std::uint32_t i = begin; i < end; ++i) {
      if (p.corners[i] >= p.points.size()) {
        return MeshFault{where() + "the point " + std::to_string(p.corners[i]) + ", there are " +
                         std::to_string(p.points.size())};
      }
    }
    triangles += n - 2;
    begin = end;
  }
  if (triangles > kMaxMeshTriangles) return too_many_triangles(triangles);
  return std::nullopt;
}

bool has_equal_corners(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

std::string text_of_edge(const TriangleMesh& mesh, const MeshEdge& e) {
  return "the edge from " + text_of_point(mesh.points[e.from]) + " to " +
         text_of_point(mesh.points[e.to]);
}

MeshFault open_fault(const TriangleMesh& mesh, const MeshEdges& edges, const MeshEdge& first) {
  const auto uses = edges.uses(first);
  const std::string where = text_of_edge(mesh, first);
  const std::size_t open = edges.unbalanced_count();
  const std::string many = counted(open, "edge", "edges") + " of " + std::to_string(edges.count()) +
                           (open == 1 ? " is open" : " are open");
  if (uses.forward + uses.backward == 1)
    return {"not closed: " + where + " belongs to one face only; " + many, true};
  return {"not a closed surface: " + where + " is used by " + std::to_string(uses.forward) +
              " of its faces one way and by " + std::to_string(uses.backward) + " the other; " +
              many,
          true};
}

/// Drops the points that no triangle uses, and numbers the others in the order of their first use.
void renumber(TriangleMesh& mesh) {
  std::vector<std::uint32_t> index(mesh.points.size(), kNoPoint);
  std::vector<Vec3> points;
  for (Triangle& t : mesh.triangles) {
    for (std::uint32_t& i : t) {
      if (index[i] == kNoPoint) {
        index[i] = static_cast<std::uint32_t>(points.size());
        points.push_back(mesh.points[i]);
      }
      i = index[i];
    }
  }
  mesh.points = std::move(points);
}

/// Turns faces until every edge is used as often one way as the other, or says why that can't be
/// done.
std::optional<MeshFault> fault_of_edges(TriangleMesh& mesh) {
  stop_if_asked();
  if (MeshEdges(mesh.triangles).unbalanced_count() == 0) return std::nullopt;
  const auto contradiction = agree_on_orientation(mesh.triangles);
  if (contradiction) {
    return MeshFault{"the surface has no inside: its faces can't be turned to agree at " +
                     text_of_edge(mesh, *contradiction)};
  }
  const MeshEdges edges(mesh.triangles);
  if (edges.unbalanced_count() == 0) return std::nullopt;
  return open_fault(mesh, edges, *edges.first_unbalanced(mesh.triangles));
}

/// Makes the orientation consistent and outward, or says why that can't be done.
std::optional<MeshFault> orient(TriangleMesh& mesh) {
  std::erase_if(mesh.triangles, has_equal_corners);
  if (mesh.triangles.empty()) return MeshFault{"no face encloses anything"};
  if (auto fault = fault_of_edges(mesh)) return fault;
  if (enclosed_volume(mesh) < 0) turn_inside_out(mesh);
  renumber(mesh);
  return std::nullopt;
}

/// The mesh of faces and points that are in order, as it is.
TriangleMesh welded_and_cut(const PolygonMesh& polygons) {
  Welder weld(polygons.points);
  std::vector<std::uint32_t> corners = polygons.corners;
  for (std::uint32_t& c : corners) c = weld[c];
  TriangleMesh mesh{weld.take(), {}};
  std::vector<std::uint32_t> face;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : polygons.face_ends) {
    stop_if_asked();
    face.clear();
    for (std::uint32_t i = begin; i < end; ++i) {
      if (face.empty() || face.back() != corners[i]) face.push_back(corners[i]);
    }
    while (face.size() > 1 && face.back() == face.front()) face.pop_back();
    if (face.size() >= 3) cut_face(mesh.points, face, polygons.side, mesh.triangles);
    begin = end;
  }
  return mesh;
}

std::variant<TriangleMesh, MeshFault> cut_and_oriented(const PolygonMesh& polygons) {
  TriangleMesh mesh = welded_and_cut(polygons);
  if (auto fault = orient(mesh)) return *std::move(fault);
  return mesh;
}

/// Moves corners to the points that they become when points within a distance are joined.
void join(std::span<const Vec3> points, double distance, std::span<std::uint32_t> corners) {
  std::vector<std::uint32_t> used(corners.begin(), corners.end());
  stoppable_sort(std::span(used));
  used.erase(std::unique(used.begin(), used.end()), used.end());
  const auto number = joined_points(points, used, distance);
  for (std::uint32_t& c : corners) c = number[c];
}

/// The largest coordinate of all corners, without its sign.
double largest_of(std::span<const Vec3> points, std::span<const std::uint32_t> corners) {
  double largest = 0;
  for (const std::uint32_t i : corners) largest = std::max(largest, max_abs(points[i]));
  return largest;
}

}  // namespace

std::string text_of_point(const Vec3& p) {
  std::string text = "(";
  for (int a = 0; a < 3; ++a) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, p[a]).ptr;
    text.append(a > 0 ? ", " : "").append(digits, end);
  }
  return text + ")";
}

double enclosed_volume(const TriangleMesh& mesh) {
  const auto before = [](const Vec3& a, const Vec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  };
  // Points that no triangle uses must not matter: they are dropped later.
  Vec3 o = mesh.points[mesh.triangles.front()[0]];
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t i : t) {
      if (before(mesh.points[i], o)) o = mesh.points[i];
    }
  }
  double sum = 0;
  for (const Triangle& t : mesh.triangles) {
    sum += dot(mesh.points[t[0]] - o, cross(mesh.points[t[1]] - o, mesh.points[t[2]] - o));
  }
  return sum / 6;
}

std::variant<TriangleMesh, MeshFault> welded_mesh(const PolygonMesh& polygons) {
  if (auto fault = fault_of_points(polygons.points)) return *std::move(fault);
  if (auto fault = fault_of_faces(polygons)) return *std::move(fault);
  return welded_and_cut(polygons);
}

std::variant<TriangleMesh, MeshFault> closed_mesh(const PolygonMesh& polygons, double join_within) {
  if (auto fault = fault_of_points(polygons.points)) return *std::move(fault);
  if (auto fault = fault_of_faces(polygons)) return *std::move(fault);
  // A mesh that is closed as written keeps all of its points, however close they are.
  auto as_written = cut_and_oriented(polygons);
  if (std::holds_alternative<TriangleMesh>(as_written)) return as_written;
  const double largest = largest_of(polygons.points, polygons.corners);
  // Two ways to compute a corner may end in neighbours among the numbers that a file can hold.
  const double written = polygons.digits > 0 ? 2 * half_unit(largest, polygons.digits) : 0;
  for (const double distance : {kRoundingShare * largest, written, join_within}) {
    if (!(distance > 0)) continue;
    PolygonMesh joined = polygons;
    join(joined.points, distance, joined.corners);
    auto closed = cut_and_oriented(joined);
    if (std::holds_alternative<TriangleMesh>(closed)) return closed;
  }
  return as_written;
}

std::variant<TriangleMesh, MeshFault> closed_mesh(TriangleMesh triangles) {
  if (auto fault = fault_of_points(triangles.points)) return *std::move(fault);
  if (triangles.triangles.size() > kMaxMeshTriangles)
    return too_many_triangles(triangles.triangles.size());
  Welder weld(triangles.points);
  for (Triangle& t : triangles.triangles) {
    stop_if_asked();
    for (std::uint32_t& i : t) {
      if (i >= triangles.points.size()) {
        return MeshFault{"face " + std::to_string(&t - triangles.triangles.data()) +
                         " has the point " + std::to_string(i) + ", there are " +
                         std::to_string(triangles.points.size())};
      }
      i = weld[i];
    }
  }
  triangles.points = weld.take();
  auto fault = orient(triangles);
  if (!fault) return triangles;
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : triangles.triangles) corners.insert(corners.end(), t.begin(), t.end());
  join(triangles.points, kRoundingShare * largest_of(triangles.points, corners), corners);
  for (std::size_t i = 0; i < corners.size(); ++i) triangles.triangles[i / 3][i % 3] = corners[i];
  if (orient(triangles)) return *std::move(fault);
  return triangles;
}

void turn_inside_out(TriangleMesh& mesh) {
  for (Triangle& t : mesh.triangles) std::swap(t[1], t[2]);
}

}  // namespace graycube
