#include "space/restrict.hpp"

#include <cmath>

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
    to_.primitives.push_back(p);
    return static_cast<std::uint32_t>(to_.primitives.size() - 1);
  }

  const Model& from_;
  Model to_;
};

}  // namespace

Model restrict_to_region(const Model& model, const MacroGrid& grid, RegionIndex region) {
  ModelExtract extract(model);
  const auto side = [&](std::uint32_t index) {
    const Primitive& p = model.primitives[index];
    if (!grid.may_touch(region, p.bounds, model.delta)) return CellSide::kOutside;
    const auto sphere = bounding_sphere(p);
    if (sphere && !grid.may_touch(region, sphere->center, sphere->radius, model.delta)) {
      return CellSide::kOutside;
    }
    return CellSide::kCrosses;
  };
  std::vector<TreeNode> kept;
  for (const Object& object : model.objects) {
    if (!grid.may_touch(region, object.bounds, model.delta)) continue;
    kept.clear();
    const std::span<const TreeNode> tree{model.nodes.data() + object.first_node, object.node_count};
    if (prune(tree, side, kept) == Pruned::kVaries) extract.add(object.id, object.bounds, kept);
  }
  return extract.take();
}

}  // namespace graycube
