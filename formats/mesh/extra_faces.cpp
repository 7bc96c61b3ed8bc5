#include "formats/mesh/extra_faces.hpp"

#include <algorithm>
#include <cstdint>
#include <set>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <variant>
#include <vector>

#include "mesh/join_points.hpp"
#include "mesh/repair_mesh.hpp"

namespace graycube {
namespace {

using Corners = std::vector<std::uint32_t>;

/// Volumes that differ by less than this factor are equal.
constexpr double kMoreThanRounding = 1 + 1e-9;

std::uint64_t edge_key(std::uint32_t from, std::uint32_t to) {
  return std::uint64_t{from} << 32 | to;
}

/// Calls `use` with each face's corners as they are, and as the numbers of points that differ,
/// without those that follow themselves.
template <typename Use>
void for_each_face(const PolygonMesh& mesh, const Corners& numbers, Use use) {
  Corners cycle;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : mesh.face_ends) {
    cycle.clear();
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t number = numbers[mesh.corners[i]];
      if (cycle.empty() || cycle.back() != number) cycle.push_back(number);
    }
    while (cycle.size() > 1 && cycle.back() == cycle.front()) cycle.pop_back();
    use(std::span(mesh.corners).subspan(begin, end - begin), cycle);
    begin = end;
  }
}

/// The mesh with those faces only for which `keeps` is true.
template <typename Keeps>
PolygonMesh filtered(const PolygonMesh& mesh, const Corners& numbers, Keeps keeps) {
  PolygonMesh rest{mesh.points, {}, {}, mesh.digits, mesh.side};
  for_each_face(mesh, numbers, [&](std::span<const std::uint32_t> face, const Corners& cycle) {
    if (keeps(cycle)) rest.add_face(face);
  });
  return rest;
}

/// A surface to which faces are added one by one. The faces around a point form fans: each goes
/// from a neighbour of the point to another, over faces that share edges; a fan that comes back to
/// where it begins surrounds the point.
class Surface {
 public:
  explicit Surface(std::size_t points) : fans_(points, 0), is_used_(points, false) {}

  /// Adds a face, unless it doesn't fit.
  bool add(const Corners& cycle) {
    if (!fits(cycle)) return false;
    std::uint32_t before = cycle.back();
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      const std::uint32_t at = cycle[i], after = cycle[(i + 1) % cycle.size()];
      edges_.insert(edge_key(at, after));
      is_used_[at] = true;
      widen_fan(at, before, after);
      before = at;
    }
    return true;
  }

 private:
  using Ends = std::unordered_map<std::uint64_t, std::uint32_t>;

  bool fits(const Corners& cycle) const {
    Corners sorted = cycle;
    std::sort(sorted.begin(), sorted.end());
    if (sorted.size() < 3 || std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
      return false;
    std::uint32_t before = cycle.back();
    for (std::size_t i = 0; i < cycle.size(); ++i) {
      const std::uint32_t at = cycle[i], after = cycle[(i + 1) % cycle.size()];
      const bool is_surrounded = is_used_[at] && fans_[at] == 0;
      if (is_surrounded || edges_.count(edge_key(at, after)) > 0) return false;
      // What surrounds a point leaves no room for its other fans.
      if (fans_[at] > 1 && closes(at, before, after)) return false;
      before = at;
    }
    return true;
  }

  /// Whether a face between two neighbours of a point makes a fan come back to where it begins.
  bool closes(std::uint32_t at, std::uint32_t before, std::uint32_t after) const {
    const auto fan = end_of_.find(edge_key(at, after));
    return fan != end_of_.end() && fan->second == before;
  }

  /// Adds a face between two neighbours of a point to the fans that end and begin there.
  void widen_fan(std::uint32_t at, std::uint32_t before, std::uint32_t after) {
    const auto taken = [&](Ends& ends, std::uint32_t neighbour) {
      const auto found = ends.find(edge_key(at, neighbour));
      if (found == ends.end()) return neighbour;
      const std::uint32_t other = found->second;
      ends.erase(found);
      --fans_[at];
      return other;
    };
    const bool is_closed = closes(at, before, after);
    const std::uint32_t start = taken(start_of_, before);
    if (is_closed) {
      end_of_.erase(edge_key(at, after));
      return;
    }
    const std::uint32_t end = taken(end_of_, after);
    end_of_[edge_key(at, start)] = end;
    start_of_[edge_key(at, end)] = start;
    ++fans_[at];
  }

  /// Edges with their direction.
  std::unordered_set<std::uint64_t> edges_;
  /// By a point and the neighbour at which one of its fans begins, the neighbour at which that
  /// ends; and the other way round. Fans that surround their point have neither.
  Ends end_of_, start_of_;
  /// How many fans a point has that don't surround it.
  std::vector<int> fans_;
  std::vector<bool> is_used_;
};

bool has_repeated_edges(const PolygonMesh& mesh, const Corners& numbers) {
  std::vector<std::uint64_t> edges;
  edges.reserve(mesh.corners.size());
  for_each_face(mesh, numbers, [&](std::span<const std::uint32_t>, const Corners& cycle) {
    for (std::size_t i = 0; i < cycle.size(); ++i)
      edges.push_back(edge_key(cycle[i], cycle[(i + 1) % cycle.size()]));
  });
  std::sort(edges.begin(), edges.end());
  return std::adjacent_find(edges.begin(), edges.end()) != edges.end();
}

/// The number of the point that each point is one with.
Corners numbers_of(const PolygonMesh& mesh, double join_within) {
  Corners used = mesh.corners;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  double largest = 0;
  for (const std::uint32_t i : used) largest = std::max(largest, max_abs(mesh.points[i]));
  return joined_points(mesh.points, used, std::max(join_within, kRoundingShare * largest));
}

/// The volume that the mesh encloses; 0 where it isn't closed, or encloses next to nothing.
double volume_of(const PolygonMesh& mesh, double join_within) {
  const auto closed = closed_mesh(mesh, join_within);
  const auto* solid = std::get_if<TriangleMesh>(&closed);
  return solid != nullptr && encloses_volume(*solid) ? enclosed_volume(*solid) : 0;
}

}  // namespace

std::optional<PolygonMesh> without_extra_faces(const PolygonMesh& mesh, double join_within) {
  // Faces and points that are in order, which closed_mesh() would say.
  if (std::holds_alternative<MeshFault>(welded_mesh(mesh))) return std::nullopt;
  const Corners numbers = numbers_of(mesh, join_within);
  if (!has_repeated_edges(mesh, numbers)) return std::nullopt;
  const double written = volume_of(mesh, join_within);
  Surface surface(mesh.points.size());
  PolygonMesh rest =
      filtered(mesh, numbers, [&](const Corners& cycle) { return surface.add(cycle); });
  // Solids that touch along an edge have edges with more than two faces, too; but where the two
  // sides of a surface are faces, it encloses nothing as it is written.
  if (volume_of(rest, join_within) > kMoreThanRounding * written) return rest;
  if (written > 0) return std::nullopt;
  std::set<Corners> known;
  rest = filtered(mesh, numbers, [&](Corners cycle) {
    std::sort(cycle.begin(), cycle.end());
    return known.insert(std::move(cycle)).second;
  });
  if (volume_of(rest, join_within) > 0) return rest;
  return std::nullopt;
}

}  // namespace graycube
