#include "mesh/tree.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>

#include "geometry/float_box.hpp"
#include "geometry/infinity.hpp"
#include "geometry/wide_tree_builder.hpp"
#include "stop_point.hpp"

namespace graycube {
namespace {

bool has_own_plane(const TriangleMesh& mesh, std::size_t triangle) {
  return mesh.plane_of.empty() || mesh.plane_of[triangle] == TriangleMesh::kOwnPlane;
}

/// Boxes are larger than their triangles by this share of the largest coordinate: a line parallel
/// to a box's side passes a point of that side to within rounding.
constexpr double kGrowth = 1e-9;

FloatBox box_of(const TriangleMesh& mesh, std::size_t triangle, double grow) {
  FloatBox box = FloatBox::nothing();
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
    // Lines meet the triangle in that plane.
    include(nearest_on(mesh.planes[mesh.plane_of[triangle]], mesh.points[i]));
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

/// Whether a triangle may touch the cell, judged by its box and by its plane.
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
    if (may_touch(nearest_on(*plane, a), nearest_on(*plane, b), nearest_on(*plane, c), cell))
      return true;
  }
  return false;
}

}  // namespace

/// The `Parts` of a mesh's WideTreeBuilder: triangles, of which blocks become items.
class MeshTreeBuilder {
 public:
  using Box = FloatBox;
  using Run = std::span<std::uint32_t>;
  static constexpr std::size_t kMostTogether = TriangleBlock::kWidth;

  MeshTreeBuilder(const TriangleMesh& mesh, MeshTree& tree)
      : mesh_(mesh), tree_(tree), order_(mesh.triangles.size()) {
    boxes_.reserve(order_.size());
    double largest = 0;
    for (const Vec3& p : mesh.points) largest = larger(max_abs(p), largest);
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      stop_if_asked();
      boxes_.push_back(box_of(mesh, t, kGrowth * largest));
    }
    tree_.planes_ = mesh.planes;
    std::iota(order_.begin(), order_.end(), 0u);
  }

  void run() {
    using Builder = WideTreeBuilder<MeshTreeBuilder>;
    // 24 levels of halving come to the end of 2²³ triangles, and all levels fit the stack.
    static_assert((Builder::kMaxChosenDepth + 24) * (WideNode::kWidth - 1) + WideNode::kWidth <=
                  MeshTree::kMaxStack);
    if (!order_.empty()) Builder(*this, tree_.nodes_).run(order_);
  }

  const FloatBox& box(std::uint32_t triangle) const { return boxes_[triangle]; }

  std::uint32_t add_item(Run run) {
    tree_.blocks_.push_back(block_of(run));
    return static_cast<std::uint32_t>(tree_.blocks_.size() - 1);
  }

  /// Splits the run at the best bin's end along the axis on which the centres are furthest apart.
  std::size_t split(Run run) {
    FloatBox centers = FloatBox::nothing();
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
    const float lo = centers.lo[axis], scale = static_cast<float>(kMaxBins) / extent;
    std::array<Bin<FloatBox>, kMaxBins> bins;
    for (const std::uint32_t i : run) {
      bins[bin_of(boxes_[i].center(axis), lo, scale)].add(boxes_[i], 1);
    }
    const auto cut = cheapest_cut<FloatBox>(bins, run.size());
    if (!(cut.cost < kFloatInf)) return run.size() / 2;
    const auto middle = std::partition(run.begin(), run.end(), [&](std::uint32_t i) {
      return bin_of(boxes_[i].center(axis), lo, scale) <= cut.bin;
    });
    return static_cast<std::size_t>(middle - run.begin());
  }

 private:
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
    return at > 0 ? std::min(static_cast<std::size_t>(std::min(at, static_cast<float>(kMaxBins))),
                             kMaxBins - 1)
                  : 0;
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
      if (!node.is_item(i)) {
        stack[size++] = node.child[i];
      } else if (may_touch_any(*this, node.item(i), box)) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace graycube
