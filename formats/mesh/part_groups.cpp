#include "formats/mesh/part_groups.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>

#include "mesh/join_points.hpp"

namespace graycube {
namespace {

/// A part's use of an edge between two joined points, the lower one first.
struct EdgeUse {
  std::uint32_t lower, higher, part;
  int direction;
  friend bool operator<(const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.lower, a.higher, a.part) < std::tie(b.lower, b.higher, b.part);
  }
  bool is_same_edge(const EdgeUse& o) const { return lower == o.lower && higher == o.higher; }
};

/// Sets that are united step by step.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  std::uint32_t root(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  /// The lower root stays one.
  void unite(std::uint32_t a, std::uint32_t b) {
    const auto [low, high] = std::minmax({root(a), root(b)});
    parent_[high] = low;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

/// The number of each point of all parts, one after the other; points of one place share theirs.
std::vector<std::uint32_t> place_numbers(std::span<const MeshPart> parts) {
  std::vector<Vec3> points;
  double largest = 0;
  for (const MeshPart& part : parts) {
    for (const Vec3& p : part.polygons.points) {
      // A part with such points is refused later.
      points.push_back(is_finite(p) ? p : Vec3{});
      largest = std::max(largest, max_abs(points.back()));
    }
  }
  std::vector<std::uint32_t> all(points.size());
  std::iota(all.begin(), all.end(), 0u);
  return joined_points(points, all, kRoundingShare * largest);
}

std::vector<EdgeUse> edge_uses(std::span<const MeshPart> parts) {
  const std::vector<std::uint32_t> place = place_numbers(parts);
  std::vector<EdgeUse> uses;
  std::uint32_t first_point = 0;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    const PolygonMesh& mesh = parts[p].polygons;
    std::uint32_t begin = 0;
    for (const std::uint32_t end : mesh.face_ends) {
      for (std::uint32_t i = begin; i < end; ++i) {
        const std::uint32_t from = place[first_point + mesh.corners[i]];
        const std::uint32_t to = place[first_point + mesh.corners[i + 1 < end ? i + 1 : begin]];
        if (from != to)
          uses.push_back({std::min(from, to), std::max(from, to), p, from < to ? 1 : -1});
      }
      begin = end;
    }
    first_point += static_cast<std::uint32_t>(mesh.points.size());
  }
  std::sort(uses.begin(), uses.end());
  return uses;
}

}  // namespace

std::vector<std::vector<std::uint32_t>> groups_at_open_edges(std::span<const MeshPart> parts) {
  const std::vector<EdgeUse> uses = edge_uses(parts);
  DisjointSets sets(parts.size());
  for (std::size_t i = 0; i < uses.size();) {
    const EdgeUse edge = uses[i];
    std::vector<std::uint32_t> open;
    while (i < uses.size() && uses[i].is_same_edge(edge)) {
      const std::uint32_t part = uses[i].part;
      int balance = 0;
      for (; i < uses.size() && uses[i].is_same_edge(edge) && uses[i].part == part; ++i)
        balance += uses[i].direction;
      if (balance != 0) open.push_back(part);
    }
    for (std::size_t n = 1; n < open.size(); ++n) sets.unite(open[0], open[n]);
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> groups;
  for (std::uint32_t p = 0; p < parts.size(); ++p) groups[sets.root(p)].push_back(p);
  std::vector<std::vector<std::uint32_t>> list;
  for (auto& [root, members] : groups) list.push_back(std::move(members));
  return list;
}

}  // namespace graycube
