#include "visibility/light_view.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "csg/half_space.hpp"
#include "geometry/infinity.hpp"
#include "visibility/light_horizons.hpp"

namespace graycube {
namespace {

/// Cones of directions reach this far beyond their texels, in units of a face's half side.
constexpr double kWiden = 1e-6;
/// Solids are grown by this many δ; distances are made this much shorter, relatively.
constexpr double kGrowDeltas = 16;
constexpr double kShorten = 1e-9;
/// Boxes that show in at most so many texels are entered texel by texel, others by quarters of a
/// face.
constexpr std::uint32_t kFewTexels = 16;
/// Larger trees are looked at by the object's bounds alone.
constexpr std::uint32_t kMaxTreeNodes = 64;

struct Range {
  double lo, hi;
};

/// Directions through a part of a face of the cube: sign on `axis`, u and v on the two axes after
/// it.
struct Cone {
  int axis;
  double sign;
  Range u, v;

  int axis_u() const { return (axis + 1) % 3; }
  int axis_v() const { return (axis + 2) % 3; }
  /// The range of a component of the directions, which have length 1 on their main axis.
  Range component(int a) const {
    if (a == axis) return {sign, sign};
    return a == axis_u() ? u : v;
  }
  double shortest() const {
    const auto least = [](const Range& r) { return r.lo > 0 ? r.lo : r.hi < 0 ? -r.hi : 0.0; };
    return std::sqrt(1 + least(u) * least(u) + least(v) * least(v));
  }
};

/// The least s at which s · (a cone's direction) may be in a solid, and on its surface, if any.
struct Begin {
  double solid, surface;
};

/// Clips [from, to] to the s ≥ 0 for which some c in [d.lo, d.hi] has s · c ≥ at.
void clip_reach(const Range& d, double at, double& from, double& to) {
  if (at <= 0) {
    if (d.hi < 0) to = std::min(to, at / d.hi);
    return;
  }
  if (d.hi <= 0) {
    to = -kInf;
    return;
  }
  from = std::max(from, at / d.hi);
}

/// The least s at which a cone may enter the box (relative to the light); infinite if it misses it.
double box_begin(const Aabb& box, const Cone& cone) {
  double from = 0, to = kInf;
  for (int a = 0; a < 3; ++a) {
    const Range d = cone.component(a);
    clip_reach(d, box.lo[a], from, to);
    clip_reach({-d.hi, -d.lo}, -box.hi[a], from, to);
  }
  return from <= to ? from : kInf;
}

/// The least s at which a cone from inside the box may leave it; 0 if the light is outside.
double box_end(const Aabb& box, const Cone& cone) {
  double end = kInf;
  for (int a = 0; a < 3; ++a) {
    if (box.lo[a] >= 0 || box.hi[a] <= 0) return 0;
    const Range d = cone.component(a);
    if (d.hi > 0) end = std::min(end, box.hi[a] / d.hi);
    if (d.lo < 0) end = std::min(end, box.lo[a] / d.lo);
  }
  return end;
}

Range along(const Vec3& normal, const Cone& cone) {
  Range sum{0, 0};
  for (int a = 0; a < 3; ++a) {
    const Range d = cone.component(a);
    sum.lo += normal[a] * (normal[a] > 0 ? d.lo : d.hi);
    sum.hi += normal[a] * (normal[a] > 0 ? d.hi : d.lo);
  }
  return sum;
}

/// The least s at which a cone may enter normal · q ≤ offset, with q relative to the light.
double half_space_begin(const Vec3& normal, double offset, const Cone& cone) {
  if (offset >= 0) return 0;
  const double steepest = along(normal, cone).lo;
  return steepest < 0 ? offset / steepest : kInf;
}

class ObjectView {
 public:
  ObjectView(const Model& model, const Object& object, const Vec3& light, std::vector<Sight>& seen)
      : model_(model),
        object_(object),
        light_(light),
        grow_(kGrowDeltas * model.delta),
        seen_(seen) {}

  void run() {
    const Aabb box = relative(object_.bounds.grown(grow_));
    for (int axis = 0; axis < 3; ++axis) {
      for (const double sign : {1.0, -1.0}) cover_face(box, axis, sign);
    }
  }

 private:
  /// Enters the object into the texels of a face: directly if its `box` (relative to the light)
  /// shows in few of them; else quarter by quarter.
  void cover_face(const Aabb& box, int axis, double sign) {
    const double nearest = sign > 0 ? box.lo[axis] : -box.hi[axis],
                 farthest = sign > 0 ? box.hi[axis] : -box.lo[axis];
    if (!(farthest > 0)) return;
    if (!(nearest > 0)) return cover(axis, sign, 0, 0, LightHorizons::kSide);
    const TexelRange u = texels_of(box, (axis + 1) % 3, nearest, farthest);
    const TexelRange v = texels_of(box, (axis + 2) % 3, nearest, farthest);
    if (u.count() * v.count() > kFewTexels) return cover(axis, sign, 0, 0, LightHorizons::kSide);
    for (std::uint32_t j = v.first; j < v.end; ++j) {
      for (std::uint32_t i = u.first; i < u.end; ++i) cover(axis, sign, i, j, 1);
    }
  }

  struct TexelRange {
    std::uint32_t first, end;
    std::uint32_t count() const { return end - first; }
  };
  /// Texels along `axis` that a box between depths `nearest` > 0 and `farthest` may cover.
  static TexelRange texels_of(const Aabb& box, int axis, double nearest, double farthest) {
    const double lo = box.lo[axis] / (box.lo[axis] > 0 ? farthest : nearest);
    const double hi = box.hi[axis] / (box.hi[axis] > 0 ? nearest : farthest);
    const auto texel = [](double at) {
      return static_cast<std::uint32_t>(
          std::clamp(0.5 * LightHorizons::kSide * (at + 1), 0.0, double{LightHorizons::kSide}));
    };
    const std::uint32_t first = texel(lo - 2 * kWiden);
    return {first, std::max(first, std::min(texel(hi + 2 * kWiden) + 1, LightHorizons::kSide))};
  }

  /// Enters the object into the texels [u, u + size) × [v, v + size) of a face.
  void cover(int axis, double sign, std::uint32_t u, std::uint32_t v, std::uint32_t size) {
    const auto range = [&](std::uint32_t first) {
      const double step = 2.0 / LightHorizons::kSide;
      return Range{first * step - 1 - kWiden, (first + size) * step - 1 + kWiden};
    };
    const Cone cone{axis, sign, range(u), range(v)};
    const double begin = object_begin(cone);
    if (begin == kInf) return;
    if (size > 1) {
      const std::uint32_t half = size / 2;
      for (const std::uint32_t i : {0u, half}) {
        for (const std::uint32_t j : {0u, half}) cover(axis, sign, u + i, v + j, half);
      }
      return;
    }
    const std::uint32_t face = 2 * static_cast<std::uint32_t>(axis) + (sign < 0 ? 1 : 0);
    seen_.push_back(
        {(face * LightHorizons::kSide + v) * LightHorizons::kSide + u,
         std::nextafter(static_cast<float>(begin * cone.shortest() * (1 - kShorten)), 0.0f)});
  }

  double object_begin(const Cone& cone) const {
    const double bounds = box_begin(relative(object_.bounds.grown(grow_)), cone);
    if (bounds == kInf || object_.node_count > kMaxTreeNodes) return bounds;
    return std::max(bounds, tree_begin(model_.tree(object_), cone).surface);
  }

  /// A surface of A ∧ B lies in both and on the surface of one; of A ∨ B, on the surface of one.
  Begin tree_begin(std::span<const TreeNode> tree, const Cone& cone) const {
    const TreeNode& root = tree.front();
    using Kind = TreeNode::Kind;
    if (root.kind == Kind::kLeaf || root.kind == Kind::kInvertedLeaf) {
      return leaf_begin(model_.primitives[root.primitive], root.kind == Kind::kInvertedLeaf, cone);
    }
    Begin all{root.kind == Kind::kAnd ? 0 : kInf, kInf};
    for (std::size_t i = 1; i < root.size; i += tree[i].size) {
      const Begin child = tree_begin(tree.subspan(i, tree[i].size), cone);
      all.solid = root.kind == Kind::kAnd ? std::max(all.solid, child.solid)
                                          : std::min(all.solid, child.solid);
      all.surface = std::min(all.surface, child.surface);
    }
    return {all.solid, std::max(all.solid, all.surface)};
  }

  Begin leaf_begin(const Primitive& p, bool inverted, const Cone& cone) const {
    if (p.kind == PrimitiveKind::kHalfSpace) {
      const auto& [n, from_origin] = csg::half_space_plane(p);
      const double offset = from_origin - dot(n, light_);
      const double inside = half_space_begin(n, offset + grow_, cone);
      const double outside = half_space_begin(-n, -offset + grow_, cone);
      return {inverted ? outside : inside, std::max(inside, outside)};
    }
    const double inside = box_begin(relative(p.bounds.grown(grow_)), cone);
    double outside = 0;
    if (p.kind == PrimitiveKind::kBox) outside = box_end(relative(p.bounds.grown(-grow_)), cone);
    return {inverted ? outside : inside, std::max(inside, outside)};
  }

  Aabb relative(const Aabb& box) const { return {box.lo - light_, box.hi - light_}; }

  const Model& model_;
  const Object& object_;
  Vec3 light_;
  double grow_;
  std::vector<Sight>& seen_;
};

}  // namespace

void LightView::look_at(const Object& object, std::vector<Sight>& seen) const {
  ObjectView(model_, object, light_, seen).run();
}

}  // namespace graycube
