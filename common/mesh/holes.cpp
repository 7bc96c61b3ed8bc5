#include "mesh/holes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/edges.hpp"

namespace graycube {
namespace {

/// A use of an edge, by its lower and higher point, and whether it goes up.
struct Use {
  std::uint32_t lower, higher;
  bool goes_up;
  bool is_same_edge(const Use& o) const { return lower == o.lower && higher == o.higher; }
};

/// The edges that closing faces need, sorted by where they begin.
std::vector<MeshEdge> missing_edges(std::span<const Triangle> triangles) {
  std::vector<Use> uses;
  uses.reserve(3 * triangles.size());
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t from = t[i], to = t[(i + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return a.lower != b.lower ? a.lower < b.lower : a.higher < b.higher;
  });
  std::vector<MeshEdge> missing;
  for (std::size_t i = 0; i < uses.size();) {
    const Use& edge = uses[i];
    std::ptrdiff_t balance = 0;
    for (; i < uses.size() && uses[i].is_same_edge(edge); ++i) balance += uses[i].goes_up ? 1 : -1;
    const bool is_down = balance > 0;
    for (std::ptrdiff_t n = std::abs(balance); n > 0; --n)
      missing.push_back(is_down ? MeshEdge{edge.higher, edge.lower}
                                : MeshEdge{edge.lower, edge.higher});
  }
  std::stable_sort(missing.begin(), missing.end(),
                   [](const MeshEdge& a, const MeshEdge& b) { return a.from < b.from; });
  return missing;
}

/// Walks along the missing edges. At every point as many of them end as begin, since those of each
/// triangle do; so a walk ends where it began.
class HoleWalk {
 public:
  HoleWalk(std::vector<MeshEdge> edges, std::size_t points)
      : edges_(std::move(edges)), next_(points + 1), place_(points, kNowhere) {
    for (const MeshEdge& e : edges_) ++next_[e.from + 1];
    for (std::size_t i = 1; i < next_.size(); ++i) next_[i] += next_[i - 1];
    end_.assign(next_.begin() + 1, next_.end());
  }

  std::vector<Hole> run() {
    for (const MeshEdge& e : edges_) {
      while (has_edge(e.from)) walk_from(e.from);
    }
    return std::move(holes_);
  }

 private:
  static constexpr std::uint32_t kNowhere = std::numeric_limits<std::uint32_t>::max();

  bool has_edge(std::uint32_t point) const { return next_[point] < end_[point]; }

  /// Walks until no edge leads on. A point that is reached again cuts off a hole.
  void walk_from(std::uint32_t point) {
    while (true) {
      if (place_[point] != kNowhere) {
        const auto begin = path_.begin() + place_[point];
        holes_.emplace_back(begin, path_.end());
        for (auto p = begin; p != path_.end(); ++p) place_[*p] = kNowhere;
        path_.erase(begin, path_.end());
      }
      if (!has_edge(point)) break;
      place_[point] = static_cast<std::uint32_t>(path_.size());
      path_.push_back(point);
      point = edges_[next_[point]++].to;
    }
  }

  std::vector<MeshEdge> edges_;
  /// Indices into the edges: the first that begins at a point and isn't walked yet, and the end.
  std::vector<std::size_t> next_, end_;
  /// Where each point is on the path.
  std::vector<std::uint32_t> place_;
  std::vector<std::uint32_t> path_;
  std::vector<Hole> holes_;
};

/// Whether the corners are within the tolerance of the line to the one farthest from the first.
bool is_along_line(const Hole& hole, std::span<const Vec3> points, double tolerance) {
  const Vec3 origin = points[hole.front()];
  Vec3 farthest;
  for (const std::uint32_t i : hole) {
    if (length(points[i] - origin) > length(farthest)) farthest = points[i] - origin;
  }
  if (length(farthest) <= tolerance) return true;
  const Vec3 direction = normalized(farthest);
  return std::all_of(hole.begin(), hole.end(), [&](std::uint32_t i) {
    return length(cross(points[i] - origin, direction)) <= tolerance;
  });
}

}  // namespace

std::vector<Hole> holes_of(std::span<const Triangle> triangles, std::size_t points) {
  return HoleWalk(missing_edges(triangles), points).run();
}

bool is_flat(const Hole& hole, std::span<const Vec3> points, double tolerance) {
  const Vec3 origin = points[hole.front()];
  Vec3 twice_area, middle;
  double around = 0;
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const Vec3 a = points[hole[i]] - origin, b = points[hole[(i + 1) % hole.size()]] - origin;
    twice_area = twice_area + cross(a, b);
    middle = middle + (1 / static_cast<double>(hole.size())) * a;
    around += length(b - a);
  }
  if (length(twice_area) <= tolerance * around) return is_along_line(hole, points, tolerance);
  const Vec3 normal = normalized(twice_area);
  return std::all_of(hole.begin(), hole.end(), [&](std::uint32_t i) {
    return std::fabs(dot(points[i] - origin - middle, normal)) <= tolerance;
  });
}

}  // namespace graycube
