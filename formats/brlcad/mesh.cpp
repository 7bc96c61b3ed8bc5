// BRL-CAD's solids of triangles, ars and bot.
#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "formats/brlcad/solids.hpp"
#include "formats/mesh/extra_faces.hpp"
#include "mesh/close_mesh.hpp"
#include "mesh/repair_mesh.hpp"

namespace graycube {
namespace {

/// The farthest that a vertex may move, in units of the growth: the tip of a spike would run
/// away.
constexpr double kMostShift = 8;
/// Keeps the equations of a vertex between nearly parallel faces solvable; this share of the growth
/// is lost by it.
constexpr double kRegular = 1e-6;

/// A symmetric 3 × 3 system, summed up face by face: the shift d with n · d = 1 for each normal, as
/// nearly as may be.
struct VertexShift {
  double xx = kRegular, yy = kRegular, zz = kRegular, xy = 0, xz = 0, yz = 0;
  Vec3 sum;

  void add(const Vec3& n, double weight) {
    xx += weight * n.x * n.x;
    yy += weight * n.y * n.y;
    zz += weight * n.z * n.z;
    xy += weight * n.x * n.y;
    xz += weight * n.x * n.z;
    yz += weight * n.y * n.z;
    sum = sum + weight * n;
  }
  Vec3 solve() const {
    const Vec3 a{xx, xy, xz}, b{xy, yy, yz}, c{xz, yz, zz};
    const double whole = dot(a, cross(b, c));
    const Vec3 d{dot(sum, cross(b, c)) / whole, dot(a, cross(sum, c)) / whole,
                 dot(a, cross(b, sum)) / whole};
    const double l = length(d);
    if (!std::isfinite(l)) return {};
    return l > kMostShift ? (kMostShift / l) * d : d;
  }
};

/// Moves every face outwards by `grow`; the mesh stays closed, since only points move.
void move_outwards(TriangleMesh& mesh, double grow) {
  std::vector<VertexShift> shifts(mesh.points.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 &p = mesh.points[a], &q = mesh.points[b], &r = mesh.points[c];
    const Vec3 n = normalized(cross(q - p, r - p));
    // A face weighs by the angle at the corner, so that how it is cut into triangles doesn't count.
    const auto weight = [](const Vec3& u, const Vec3& v) {
      return length(cross(normalized(u), normalized(v)));
    };
    shifts[a].add(n, weight(q - p, r - p));
    shifts[b].add(n, weight(r - q, p - q));
    shifts[c].add(n, weight(p - r, q - r));
  }
  for (std::size_t i = 0; i < shifts.size(); ++i)
    mesh.points[i] = mesh.points[i] + grow * shifts[i].solve();
}

/// What is said of all faults of a kind is apart from where this one is.
BrlcadNode left_out(const MeshFault& fault) {
  constexpr std::string_view kBetween = ": ";
  const std::size_t end = std::min(fault.why.find(kBetween), fault.why.size());
  BrlcadNode node;
  node.problem = "its mesh: " + fault.why.substr(0, end);
  if (end < fault.why.size()) node.detail = fault.why.substr(end + kBetween.size());
  return node;
}

/// The closed surface, without faces that are one too many, which `change` tells: for rt several
/// hits of a ray at one place are one.
std::variant<TriangleMesh, MeshFault> closed_surface(const TriangleMesh& surface,
                                                     std::string& change) {
  auto closed = closed_mesh(surface);
  const auto is_solid = [](const std::variant<TriangleMesh, MeshFault>& found) {
    const auto* mesh = std::get_if<TriangleMesh>(&found);
    return mesh != nullptr && encloses_volume(*mesh);
  };
  if (is_solid(closed)) return closed;
  PolygonMesh polygons;
  polygons.points = surface.points;
  for (const Triangle& t : surface.triangles) polygons.add_face(t);
  const auto rest = without_extra_faces(polygons, 0);
  if (!rest) return closed;
  auto thinned = closed_mesh(*rest);
  if (!is_solid(thinned)) return closed;
  change = "faces that the mesh has twice or more often count once";
  return thinned;
}

}  // namespace

BrlcadNode brlcad_mesh_node(const BrlcadMesh& mesh, const Affine& to_world, double grow) {
  TriangleMesh surface;
  surface.points.reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) {
    surface.points.push_back(to_world.point(v));
    if (!(max_abs(surface.points.back()) <= kMostBrlcadSize)) {
      return {std::nullopt, "its numbers are out of range", false, {}, {}};
    }
  }
  surface.triangles = mesh.faces;
  std::string change;
  auto closed = closed_surface(surface, change);
  if (auto* fault = std::get_if<MeshFault>(&closed)) return left_out(*fault);
  auto& solid = std::get<TriangleMesh>(closed);
  if (grow != 0) {
    move_outwards(solid, grow);
    // Points that have met are joined.
    closed = closed_mesh(std::move(solid));
    if (auto* fault = std::get_if<MeshFault>(&closed)) return left_out(*fault);
  }
  CsgNode node;
  node.value = MeshShape{std::move(std::get<TriangleMesh>(closed))};
  return {std::move(node), {}, false, std::move(change), {}};
}

}  // namespace graycube
