#include "mesh/repair_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/aabb.hpp"
#include "mesh/cut_face.hpp"
#include "mesh/edges.hpp"
#include "mesh/holes.hpp"
#include "mesh/join_points.hpp"

namespace graycube {
namespace {

/// The distances at which corners are joined, one after the other, as shares of the longest side.
constexpr std::array kJoinShares{1e-9, 1e-8, 1e-7, 1e-6, 1e-5, kRepairShare};
/// A volume smaller than this share of the longest side's cube is that of a sheet.
constexpr double kLeastVolumeShare = 1e-12;

double longest_side(const TriangleMesh& mesh) {
  Aabb box = Aabb::nothing();
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t i : t) box.include(mesh.points[i]);
  }
  return max_abs(box.hi - box.lo);
}

bool has_equal_corners(const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; }

/// The edges that an odd number of triangles uses, however these are turned.
struct OpenEdges {
  std::size_t count = 0;
  /// Their ends, in order.
  std::vector<std::uint32_t> points;
};

OpenEdges open_edges(const TriangleMesh& mesh) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) edges.emplace_back(std::minmax({t[i], t[(i + 1) % 3]}));
  }
  std::sort(edges.begin(), edges.end());
  OpenEdges open;
  for (std::size_t i = 0; i < edges.size();) {
    const auto edge = edges[i];
    std::size_t uses = 0;
    for (; i < edges.size() && edges[i] == edge; ++i) ++uses;
    if (uses % 2 == 0) continue;
    ++open.count;
    open.points.insert(open.points.end(), {edge.first, edge.second});
  }
  std::sort(open.points.begin(), open.points.end());
  open.points.erase(std::unique(open.points.begin(), open.points.end()), open.points.end());
  return open;
}

enum class Doubled { kSameWay, kEitherWay };

/// Drops triangles with the same corners, turned the same way or either way, as one before; returns
/// how many.
std::size_t drop_doubled(TriangleMesh& mesh, Doubled which) {
  const auto key_of = [&](std::uint32_t n) {
    Triangle t = mesh.triangles[n];
    if (which == Doubled::kEitherWay) std::sort(t.begin(), t.end());
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    return t;
  };
  std::vector<std::pair<Triangle, std::uint32_t>> sorted;
  sorted.reserve(mesh.triangles.size());
  for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n) sorted.emplace_back(key_of(n), n);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i - 1].first) mesh.triangles[sorted[i].second] = {0, 0, 0};
  }
  return std::erase_if(mesh.triangles, has_equal_corners);
}

/// Drops triangles that are there twice, turned the same way. Those that are there both ways are
/// the two sides of a wall, or of all or some of the surface: one side is dropped where that leaves
/// fewer open edges, or where both sides enclose nothing.
void drop_doubled(TriangleMesh& mesh, MeshRepairs& repairs) {
  repairs.dropped_faces = drop_doubled(mesh, Doubled::kSameWay);
  TriangleMesh one_sided = mesh;
  const std::size_t dropped = drop_doubled(one_sided, Doubled::kEitherWay);
  if (dropped == 0) return;
  const std::size_t before = open_edges(mesh).count, after = open_edges(one_sided).count;
  if (after > before || (after == before && encloses_volume(mesh))) return;
  repairs.dropped_faces += dropped;
  mesh = std::move(one_sided);
}

/// Notes that these points got other numbers.
void note_joined(const TriangleMesh& mesh, const std::vector<std::uint32_t>& points,
                 const std::vector<std::uint32_t>& number, MeshRepairs& repairs) {
  for (const std::uint32_t i : points) {
    if (number[i] == i) continue;
    ++repairs.joined_corners;
    repairs.farthest_joined =
        std::max(repairs.farthest_joined, max_abs(mesh.points[i] - mesh.points[number[i]]));
  }
}

std::vector<std::uint32_t> corners_of(const TriangleMesh& mesh) {
  std::vector<std::uint32_t> corners;
  for (const Triangle& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// Joins those of the points that are within a distance, and drops triangles that are doubled then.
/// That counts only if no more than `most_left` edges are open afterwards.
void try_to_join(TriangleMesh& mesh, OpenEdges& open, const std::vector<std::uint32_t>& points,
                 double distance, std::size_t most_left, MeshRepairs& repairs) {
  const auto number = joined_points(mesh.points, points, distance);
  TriangleMesh joined = mesh;
  for (Triangle& t : joined.triangles) {
    for (std::uint32_t& i : t) i = number[i];
  }
  std::erase_if(joined.triangles, has_equal_corners);
  const std::size_t dropped = drop_doubled(joined, Doubled::kSameWay);
  OpenEdges left = open_edges(joined);
  if (left.count > most_left) return;
  note_joined(mesh, points, number, repairs);
  repairs.dropped_faces += dropped;
  mesh = std::move(joined);
  open = std::move(left);
}

/// Joins corners at growing distances, until no edge is open: those of open edges where that leaves
/// fewer of them, and all corners where that closes the mesh. A strip that goes on beyond its seam
/// ends at open edges, but lies on faces whose own edges have two faces each.
void join_corners(TriangleMesh& mesh, double side, MeshRepairs& repairs) {
  OpenEdges open = open_edges(mesh);
  for (const double share : kJoinShares) {
    if (open.count == 0) return;
    const std::vector<std::uint32_t> ends = open.points;
    try_to_join(mesh, open, ends, share * side, open.count - 1, repairs);
    if (open.count > 0) try_to_join(mesh, open, corners_of(mesh), share * side, 0, repairs);
  }
}

MeshFault bent_or_large(const std::vector<const Hole*>& left, const TriangleMesh& mesh,
                        double tolerance) {
  const Hole& first = *left.front();
  std::string why = "not closed even when repaired: " + std::to_string(left.size()) +
                    (left.size() == 1 ? " hole is left" : " holes are left") + ", one of " +
                    std::to_string(first.size()) + " edges at " +
                    text_of_point(mesh.points[first.front()]);
  if (first.size() > kMaxFilledEdges) {
    why += "; holes of up to " + std::to_string(kMaxFilledEdges) + " edges are filled";
  } else if (!is_flat(first, mesh.points, tolerance)) {
    why += "; only flat holes are filled";
  }
  return {std::move(why), true};
}

/// Adds a face for each flat hole, or says which holes are left.
std::optional<MeshFault> fill_holes(TriangleMesh& mesh, double tolerance, MeshRepairs& repairs) {
  const std::vector<Hole> holes = holes_of(mesh.triangles, mesh.points.size());
  std::vector<const Hole*> left;
  for (const Hole& hole : holes) {
    if (hole.size() > kMaxFilledEdges || !is_flat(hole, mesh.points, tolerance)) {
      left.push_back(&hole);
      continue;
    }
    cut_face(mesh.points, hole, FaceSide::kOuter, mesh.triangles);
    ++repairs.filled_holes;
    repairs.most_filled_edges = std::max(repairs.most_filled_edges, hole.size());
  }
  if (left.empty()) return std::nullopt;
  return bent_or_large(left, mesh, tolerance);
}

}  // namespace

bool encloses_volume(const TriangleMesh& mesh) {
  const double side = longest_side(mesh);
  return std::fabs(enclosed_volume(mesh)) > kLeastVolumeShare * side * side * side;
}

std::variant<RepairedMesh, MeshFault> repaired_mesh(const PolygonMesh& polygons) {
  auto welded = welded_mesh(polygons);
  if (auto* fault = std::get_if<MeshFault>(&welded)) return std::move(*fault);
  TriangleMesh& mesh = std::get<TriangleMesh>(welded);
  auto closed = closed_mesh(mesh);
  auto* as_it_is = std::get_if<TriangleMesh>(&closed);
  if (as_it_is != nullptr && encloses_volume(*as_it_is))
    return RepairedMesh{std::move(*as_it_is), {}};
  const auto* why = std::get_if<MeshFault>(&closed);
  if (why != nullptr && !why->is_open) return *why;
  MeshRepairs repairs;
  std::erase_if(mesh.triangles, has_equal_corners);
  const double side = longest_side(mesh);
  drop_doubled(mesh, repairs);
  join_corners(mesh, side, repairs);
  if (const auto contradiction = agree_on_orientation(mesh.triangles)) {
    return MeshFault{
        "the surface has no inside, even when repaired: its faces can't be turned to "
        "agree at " +
        text_of_point(mesh.points[contradiction->from])};
  }
  if (auto fault = fill_holes(mesh, kRepairShare * side, repairs)) return *std::move(fault);
  closed = closed_mesh(std::move(mesh));
  if (auto* fault = std::get_if<MeshFault>(&closed)) return std::move(*fault);
  auto& result = std::get<TriangleMesh>(closed);
  if (!encloses_volume(result)) return MeshFault{"encloses no volume even when repaired: a sheet"};
  return RepairedMesh{std::move(result), repairs};
}

}  // namespace graycube
