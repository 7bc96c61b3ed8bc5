#include "mesh/tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "geometry/culling_ray.hpp"

namespace graycube {
namespace {

constexpr float kFloatInf = std::numeric_limits<float>::infinity();
constexpr std::size_t kBins = 16;
/// From here on groups are simply halved: 24 more levels end 2²³ triangles, and all fit the stack.
constexpr std::size_t kMaxChosenDepth = 40;
static_assert((kMaxChosenDepth + 24) * (WideNode::kWidth - 1) + WideNode::kWidth <=
              MeshTree::kMaxStack);

bool has_own_plane(const TriangleMesh& mesh, std::size_t triangle) {
  return mesh.plane_of.empty() || mesh.plane_of[triangle] == TriangleMesh::kOwnPlane;
}
Vec3 on_plane(const Vec3& p, const Plane& plane) {
  return p + (plane.offset - dot(plane.normal, p)) * plane.normal;
}

struct FloatBox {
  std::array<float, 3> lo{kFloatInf, kFloatInf, kFloatInf}, hi{-kFloatInf, -kFloatInf, -kFloatInf};

  void include(const FloatBox& o) {
    for (std::size_t a = 0; a < 3; ++a) {
      lo[a] = std::min(lo[a], o.lo[a]);
      hi[a] = std::max(hi[a], o.hi[a]);
    }
  }
  float half_area() const {
    const float x = hi[0] - lo[0], y = hi[1] - lo[1], z = hi[2] - lo[2];
    return x * y + y * z + z * x;
  }
  float center(std::size_t a) const { return 0.5f * lo[a] + 0.5f * hi[a]; }
};

/// Boxes are larger than their triangles by this share of the largest coordinate: a line parallel
/// to a box's side passes a point of that side to within rounding.
constexpr double kGrowth = 1e-9;

FloatBox box_of(const TriangleMesh& mesh, std::size_t triangle, double grow) {
  FloatBox box;
  const auto include = [&](const Vec3& p) {
    for (std::size_t a = 0; a < 3; ++a) {
      const double v = p[static_cast<int>(a)];
      box.lo[a] = std::min(box.lo[a], float_below(v - grow));
      box.hi[a] = std::max(box.hi[a], float_above(v + grow));
    }
  };
  for (const std::uint32_t i : mesh.triangles[triangle]) {
    include(mesh.points[i]);
    if (has_own_plane(mesh, triangle)) continue;
    // Lines meet it in the plane.
    include(on_plane(mesh.points[i], mesh.planes[mesh.plane_of[triangle]]));
  }
  return box;
}

bool touches(const WideNode& node, std::size_t child, const Aabb& box) {
  bool meets = true;
  for (std::size_t a = 0; a < 3; ++a) {
    const int axis = static_cast<int>(a);
    meets = meets && static_cast<double>(node.planes[0][a][child]) <= box.hi[axis] &&
            static_cast<double>(node.planes[1][a][child]) >= box.lo[axis];
  }
  return meets;
}

/// By the boxes, and by the triangle's plane.
bool may_touch(const Vec3& a, const Vec3& b, const Vec3& c, const Aabb& cell) {
  Aabb box{a, a};
  box.include(b);
  box.include(c);
  if (!box.overlaps(cell)) return false;
  const auto absolute = [](const Vec3& v) {
    return Vec3{std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)};
  };
  const Aabb near = intersection_of(box, cell);
  const Vec3 n = cross(b - a, c - a), middle = near.center() - a, half = 0.5 * (near.hi - near.lo);
  const Vec3 size = absolute(n);
  const double rounding = 1e-12 * (dot(size, absolute(middle)) + dot(size, half));
  return !(std::fabs(dot(n, middle)) > dot(size, half) + rounding);
}

bool may_touch_any(const MeshTree& tree, std::uint32_t index, const Aabb& cell) {
  const TriangleBlock& block = tree.blocks()[index];
  for (std::uint32_t i = 0; i < TriangleBlock::kWidth; ++i) {
    const Vec3 a = block.corner(i, 0), b = block.corner(i, 1), c = block.corner(i, 2);
    if (may_touch(a, b, c, cell)) return true;
    const Plane* plane =
        tree.plane_of(index * static_cast<std::uint32_t>(TriangleBlock::kWidth) + i);
    if (plane == nullptr) continue;
    if (may_touch(on_plane(a, *plane), on_plane(b, *plane), on_plane(c, *plane), cell)) return true;
  }
  return false;
}

}  // namespace

class MeshTreeBuilder {
 public:
  MeshTreeBuilder(const TriangleMesh& mesh, MeshTree& tree)
      : mesh_(mesh), tree_(tree), order_(mesh.triangles.size()) {
    boxes_.reserve(order_.size());
    double largest = 0;
    for (const Vec3& p : mesh.points) largest = larger(max_abs(p), largest);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      boxes_.push_back(box_of(mesh, t, kGrowth * largest));
    tree_.planes_ = mesh.planes;
    std::iota(order_.begin(), order_.end(), 0u);
  }

  void run() {
    if (order_.empty()) return;
    tree_.nodes_.emplace_back();
    build_node(0, order_, 0);
  }

 private:
  using Run = std::span<std::uint32_t>;
  struct Group {
    Run run;
    FloatBox box;
  };
  struct Bin {
    FloatBox box;
    std::size_t count = 0;
  };

  Group group_of(Run run) const {
    Group g{run, {}};
    for (const std::uint32_t i : run) g.box.include(boxes_[i]);
    return g;
  }

  void build_node(std::size_t index, Run run, std::size_t depth) {
    std::vector<Group> groups{group_of(run)};
    while (groups.size() < WideNode::kWidth) {
      // The group with the largest surface is opened next.
      std::size_t widest = groups.size();
      for (std::size_t g = 0; g < groups.size(); ++g) {
        if (groups[g].run.size() <= TriangleBlock::kWidth) continue;
        if (widest == groups.size() || groups[g].box.half_area() > groups[widest].box.half_area())
          widest = g;
      }
      if (widest == groups.size()) break;
      const Run all = groups[widest].run;
      const std::size_t middle = depth < kMaxChosenDepth ? partition(all) : all.size() / 2;
      groups[widest] = group_of(all.first(middle));
      groups.push_back(group_of(all.subspan(middle)));
    }
    WideNode node;
    for (std::size_t g = 0; g < WideNode::kWidth; ++g) {
      for (std::size_t a = 0; a < 3; ++a) {
        node.planes[0][a][g] = g < groups.size() ? groups[g].box.lo[a] : kFloatInf;
        node.planes[1][a][g] = g < groups.size() ? groups[g].box.hi[a] : -kFloatInf;
      }
      if (g >= groups.size()) continue;
      const Run& own = groups[g].run;
      if (own.size() <= TriangleBlock::kWidth) {
        node.child[g] = WideNode::kItemFlag | static_cast<std::uint32_t>(tree_.blocks_.size());
        tree_.blocks_.push_back(block_of(own));
      } else {
        node.child[g] = static_cast<std::uint32_t>(tree_.nodes_.size());
        tree_.nodes_.emplace_back();
      }
    }
    tree_.nodes_[index] = node;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (groups[g].run.size() > TriangleBlock::kWidth)
        build_node(node.child[g], groups[g].run, depth + 1);
    }
  }

  TriangleBlock block_of(Run run) {
    TriangleBlock block;
    if (!mesh_.plane_of.empty()) {
      for (std::size_t i = 0; i < TriangleBlock::kWidth; ++i) {
        tree_.plane_of_.push_back(mesh_.plane_of[run[i < run.size() ? i : 0]]);
      }
    }
    for (std::size_t i = 0; i < TriangleBlock::kWidth; ++i) {
      const Triangle& t = mesh_.triangles[run[i < run.size() ? i : 0]];
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3& p = mesh_.points[t[i < run.size() ? c : 0]];
        for (std::size_t a = 0; a < 3; ++a) block.corners[c][a][i] = p[static_cast<int>(a)];
      }
    }
    return block;
  }

  static std::size_t bin_of(float center, float lo, float scale) {
    const float at = (center - lo) * scale;
    // Written so that NaN, which boxes beyond all floats would give, stays within the bins.
    return at > 0 ? std::min(static_cast<std::size_t>(std::min(at, static_cast<float>(kBins))),
                             kBins - 1)
                  : 0;
  }

  /// Splits the run where the surface-area heuristic wants it; the size of the first part, between
  /// both ends.
  std::size_t partition(Run run) {
    FloatBox centers;
    for (const std::uint32_t i : run) {
      const FloatBox& b = boxes_[i];
      const std::array<float, 3> c{b.center(0), b.center(1), b.center(2)};
      centers.include({c, c});
    }
    std::size_t axis = 0;
    for (std::size_t a = 1; a < 3; ++a) {
      if (centers.hi[a] - centers.lo[a] > centers.hi[axis] - centers.lo[axis]) axis = a;
    }
    const float extent = centers.hi[axis] - centers.lo[axis];
    if (!(extent > 0) || !std::isfinite(extent)) return run.size() / 2;
    const float lo = centers.lo[axis], scale = static_cast<float>(kBins) / extent;
    std::array<Bin, kBins> bins;
    for (const std::uint32_t i : run) {
      Bin& bin = bins[bin_of(boxes_[i].center(axis), lo, scale)];
      bin.box.include(boxes_[i]);
      ++bin.count;
    }
    const std::size_t split = best_split(bins, run.size());
    if (split == kBins) return run.size() / 2;
    const auto middle = std::partition(run.begin(), run.end(), [&](std::uint32_t i) {
      return bin_of(boxes_[i].center(axis), lo, scale) <= split;
    });
    return static_cast<std::size_t>(middle - run.begin());
  }

  /// The last bin of the first part; kBins when there is no split.
  static std::size_t best_split(const std::array<Bin, kBins>& bins, std::size_t all) {
    std::array<float, kBins> above_cost{};
    Bin above;
    for (std::size_t b = kBins - 1; b > 0; --b) {
      above.box.include(bins[b].box);
      above.count += bins[b].count;
      above_cost[b] =
          above.count == 0 ? 0 : above.box.half_area() * static_cast<float>(above.count);
    }
    Bin below;
    std::size_t best = kBins;
    float best_cost = kFloatInf;
    for (std::size_t b = 0; b + 1 < kBins; ++b) {
      below.box.include(bins[b].box);
      below.count += bins[b].count;
      if (below.count == 0 || below.count == all) continue;
      const float cost =
          below.box.half_area() * static_cast<float>(below.count) + above_cost[b + 1];
      if (cost < best_cost) {
        best_cost = cost;
        best = b;
      }
    }
    return best;
  }

  const TriangleMesh& mesh_;
  MeshTree& tree_;
  std::vector<FloatBox> boxes_;
  std::vector<std::uint32_t> order_;
};

MeshTree::MeshTree(const TriangleMesh& mesh) { MeshTreeBuilder(mesh, *this).run(); }

bool MeshTree::may_touch(const Aabb& box) const {
  if (nodes_.empty()) return false;
  std::uint32_t stack[kMaxStack];
  std::size_t size = 0;
  stack[size++] = 0;
  while (size > 0) {
    const WideNode& node = nodes_[stack[--size]];
    for (std::size_t i = 0; i < WideNode::kWidth; ++i) {
      if (!touches(node, i, box)) continue;
      if ((node.child[i] & WideNode::kItemFlag) == 0) {
        stack[size++] = node.child[i];
      } else if (may_touch_any(*this, node.child[i] & ~WideNode::kItemFlag, box)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace graycube
