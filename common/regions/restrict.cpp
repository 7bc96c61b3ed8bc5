#include "regions/restrict.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "csg/bounding_sphere.hpp"
#include "csg/tree.hpp"
#include "regions/kept_trees.hpp"

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

  void add(const Object& object, std::span<const TreeNode> tree) {
    const auto first = static_cast<std::uint32_t>(to_.nodes.size());
    for (TreeNode n : tree) {
      if (n.size == 1) n.primitive = copy(n.primitive);
      to_.nodes.push_back(n);
    }
    to_.objects.push_back(
        {object.id, first, static_cast<std::uint32_t>(tree.size()), object.bounds});
  }

  /// Takes memory for that many objects and, in all, that many nodes.
  void reserve(std::size_t objects, std::size_t nodes) {
    to_.objects.reserve(objects);
    to_.nodes.reserve(nodes);
    to_.primitives.reserve(nodes);
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
    if (csg::has_outline(p.kind)) p.outline = copy_outline(p.outline);
    to_.primitives.push_back(p);
    return static_cast<std::uint32_t>(to_.primitives.size() - 1);
  }

  /// Primitives may share an outline, which is copied once.
  std::uint32_t copy_outline(std::uint32_t index) {
    const auto [known, is_new] =
        outlines_.try_emplace(index, static_cast<std::uint32_t>(to_.outlines.size()));
    if (is_new) to_.outlines.push_back(from_.outlines[index]);
    return known->second;
  }

  const Model& from_;
  Model to_;
  /// The copies' indices.
  std::unordered_map<std::uint32_t, std::uint32_t> outlines_;
};

/// Whether a bounded thing may reach into any region of a share: a column, a row and a slab of it.
class ShareTest {
 public:
  ShareTest(const MacroGrid& grid, const RegionShare& share, double grow)
      : grid_(grid), grow_(grow) {
    for (std::uint32_t c = share.column; c < grid.columns(); c += share.columns)
      columns_.push_back(c);
    for (std::uint32_t r = share.row; r < grid.rows(); r += share.rows) rows_.push_back(r);
    for (std::uint32_t s = share.slab; s < grid.slabs(); s += share.slabs) slabs_.push_back(s);
  }

  bool may_touch(const Aabb& box) const {
    return std::ranges::any_of(
               columns_, [&](std::uint32_t c) { return grid_.column_may_touch(c, box, grow_); }) &&
           std::ranges::any_of(
               rows_, [&](std::uint32_t r) { return grid_.row_may_touch(r, box, grow_); }) &&
           std::ranges::any_of(
               slabs_, [&](std::uint32_t s) { return grid_.slab_may_touch(s, box, grow_); });
  }
  /// The box and the sphere must reach into the same column, the same row and the same slab.
  bool may_touch(const Aabb& box, const BoundingSphere& s) const {
    return std::ranges::any_of(columns_,
                               [&](std::uint32_t c) {
                                 return grid_.column_may_touch(c, box, grow_) &&
                                        grid_.column_may_touch(c, s.center, s.radius, grow_);
                               }) &&
           std::ranges::any_of(rows_,
                               [&](std::uint32_t r) {
                                 return grid_.row_may_touch(r, box, grow_) &&
                                        grid_.row_may_touch(r, s.center, s.radius, grow_);
                               }) &&
           std::ranges::any_of(slabs_, [&](std::uint32_t slab) {
             return grid_.slab_may_touch(slab, box, grow_) &&
                    grid_.slab_may_touch(slab, s.center, s.radius, grow_);
           });
  }

 private:
  const MacroGrid& grid_;
  double grow_;
  std::vector<std::uint32_t> columns_, rows_, slabs_;
};

}  // namespace

ModelContents contents_of_share(const Model& model, const MacroGrid& grid, const RegionShare& share,
                                const PicturePart* beside) {
  ModelContents contents{std::vector<bool>(model.objects.size()), {}};
  std::vector<ShareTest> tests{ShareTest(grid, share, model.delta)};
  if (beside != nullptr)
    tests.emplace_back(beside->grid, only(beside->region, beside->grid), model.delta);
  const auto may_touch = [&tests](const auto&... bounds) {
    return std::ranges::any_of(tests,
                               [&](const ShareTest& test) { return test.may_touch(bounds...); });
  };
  const auto side = [&](std::uint32_t index) {
    const Primitive& p = model.primitives[index];
    const auto sphere = bounding_sphere(p);
    const bool touches = sphere ? may_touch(p.bounds, *sphere) : may_touch(p.bounds);
    return touches ? CellSide::kCrosses : CellSide::kOutside;
  };
  std::vector<TreeNode> kept;
  for (std::uint32_t i = 0; i < model.objects.size(); ++i) {
    const Object& object = model.objects[i];
    if (!may_touch(object.bounds)) continue;
    kept.clear();
    if (prune(model.tree(object), side, kept) != Pruned::kVaries) continue;
    // Pruning folds nothing unless a leaf goes, so an equal number of nodes means the whole tree.
    if (kept.size() == object.node_count) {
      contents.is_whole[i] = true;
    } else {
      contents.parts.push_back({i, kept});
    }
  }
  return contents;
}

void ModelContents::hold_whole(const std::vector<bool>& objects) {
  for (std::size_t i = 0; i < is_whole.size(); ++i) is_whole[i] = is_whole[i] || objects[i];
  std::erase_if(parts, [&](const Part& part) { return is_whole[part.object]; });
}

Model extract(const Model& model, const ModelContents& contents) {
  ModelExtract extract(model);
  std::size_t objects = 0, nodes = 0;
  for_each_kept(model, contents, [&](const Object&, std::span<const TreeNode> tree) {
    ++objects;
    nodes += tree.size();
  });
  extract.reserve(objects, nodes);
  for_each_kept(model, contents, [&](const Object& object, std::span<const TreeNode> tree) {
    extract.add(object, tree);
  });
  return extract.take();
}

}  // namespace graycube
