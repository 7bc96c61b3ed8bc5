#include "space/restrict.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "csg/bounding_sphere.hpp"
#include "csg/tree.hpp"

namespace graycube {
namespace {

/// Copies what is used of one model into another.
class ModelExtract {
 public:
  explicit ModelExtract(const Model& from) : from_(from) {
    to_.settings = from.settings;
    to_.delta = from.delta;
    to_.materials = from.materials;
  }

  void add(std::uint32_t id, const Aabb& bounds, std::vector<TreeNode> tree) {
    Object object{id, static_cast<std::uint32_t>(to_.nodes.size()),
                  static_cast<std::uint32_t>(tree.size()), bounds};
    for (TreeNode& n : tree) {
      if (n.size == 1) n.primitive = copy(n.primitive);
    }
    to_.nodes.insert(to_.nodes.end(), tree.begin(), tree.end());
    to_.objects.push_back(object);
  }

  Model take() { return std::move(to_); }

 private:
  /// A primitive stands in one place of one tree, so each is copied once.
  std::uint32_t copy(std::uint32_t index) {
    Primitive p = from_.primitives[index];
    const auto first = from_.planes.begin() + p.first_plane;
    p.first_plane = static_cast<std::uint32_t>(to_.planes.size());
    if (p.plane_count == 0) p.first_plane = 0;
    to_.planes.insert(to_.planes.end(), first, first + p.plane_count);
    if (p.kind == PrimitiveKind::kMesh) {
      to_.meshes.push_back(from_.meshes[p.mesh]);
      p.mesh = static_cast<std::uint32_t>(to_.meshes.size() - 1);
    }
    to_.primitives.push_back(p);
    return static_cast<std::uint32_t>(to_.primitives.size() - 1);
  }

  const Model& from_;
  Model to_;
};

/// Whether a bounded thing may reach into any region of a share: a column of the share and a row of it.
class ShareTest {
 public:
  ShareTest(const MacroGrid& grid, const RegionShare& share, double grow) : grid_(grid), grow_(grow) {
    for (std::uint32_t c = share.column; c < grid.columns(); c += share.columns) columns_.push_back(c);
    for (std::uint32_t r = share.row; r < grid.rows(); r += share.rows) rows_.push_back(r);
  }

  bool may_touch(const Aabb& box) const {
    return std::ranges::any_of(
               columns_, [&](std::uint32_t c) { return grid_.column_may_touch(c, box, grow_); }) &&
           std::ranges::any_of(rows_,
                               [&](std::uint32_t r) { return grid_.row_may_touch(r, box, grow_); });
  }
  /// The box and the sphere must reach into the same column, and into the same row.
  bool may_touch(const Aabb& box, const BoundingSphere& s) const {
    return std::ranges::any_of(columns_,
                               [&](std::uint32_t c) {
                                 return grid_.column_may_touch(c, box, grow_) &&
                                        grid_.column_may_touch(c, s.center, s.radius, grow_);
                               }) &&
           std::ranges::any_of(rows_, [&](std::uint32_t r) {
             return grid_.row_may_touch(r, box, grow_) &&
                    grid_.row_may_touch(r, s.center, s.radius, grow_);
           });
  }

 private:
  const MacroGrid& grid_;
  double grow_;
  std::vector<std::uint32_t> columns_, rows_;
};

}  // namespace

Model restrict_to_share(const Model& model, const MacroGrid& grid, const RegionShare& share) {
  ModelExtract extract(model);
  const ShareTest test(grid, share, model.delta);
  const auto side = [&](std::uint32_t index) {
    const Primitive& p = model.primitives[index];
    const auto sphere = bounding_sphere(p);
    const bool touches = sphere ? test.may_touch(p.bounds, *sphere) : test.may_touch(p.bounds);
    return touches ? CellSide::kCrosses : CellSide::kOutside;
  };
  std::vector<TreeNode> kept;
  for (const Object& object : model.objects) {
    if (!test.may_touch(object.bounds)) continue;
    kept.clear();
    const std::span<const TreeNode> tree{model.nodes.data() + object.first_node, object.node_count};
    if (prune(tree, side, kept) == Pruned::kVaries) extract.add(object.id, object.bounds, kept);
  }
  return extract.take();
}

}  // namespace graycube
