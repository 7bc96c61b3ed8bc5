#include "crossings/bsp.hpp"

#include <utility>

#include "crossings/bsp_assembly.hpp"
#include "crossings/split_finder.hpp"
#include "csg/tree.hpp"

namespace graycube {
namespace {

/// What all leaf regions may hold together: so many literals, and so many for each literal of the
/// scene. Solids that run right through each other by the hundred thousand, as the holes of a
/// sponge do, would have no end of it otherwise.
constexpr double kLiteralsInAll = 1 << 18, kLiteralsForEach = 16;

class BspBuilder {
 public:
  BspBuilder(const Model& model, const BspOptions& options)
      : model_(model), options_(options), assembly_(model) {}

  Bsp run(CellContent content) {
    const Aabb extent = finite_extent(content, model_);
    split_off_outside(extent, std::move(content));
    return assembly_.finish();
  }

 private:
  /// Cuts the unbounded space around the finite primitives off with six planes; the cells outside
  /// hold only unbounded primitives and are not cut further.
  void split_off_outside(const Aabb& extent, CellContent content) {
    std::uint32_t node = 0;
    Aabb cell = Aabb::everything();
    if (extent.is_empty()) {
      assembly_.close(node, cell, content);
      return;
    }
    const Aabb inner = extent.grown(4 * model_.delta);
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool upper : {false, true}) {
        const double at = upper ? inner.hi[axis] : inner.lo[axis];
        const std::uint32_t child = assembly_.cut(node, axis, at);
        Aabb outside = cell;
        (upper ? outside.lo : outside.hi)[axis] = at;
        (upper ? cell.hi : cell.lo)[axis] = at;
        assembly_.close(upper ? child + 1 : child, outside,
                        restricted_to(content, model_, outside));
        node = upper ? child : child + 1;
      }
    }
    content = restricted_to(content, model_, cell);
    const double room =
        kLiteralsInAll + kLiteralsForEach * static_cast<double>(content.literal_count());
    subdivide(node, cell, std::move(content), 6, room);
  }

  /// Adds boxes of the surfaces in a cell: each primitive's bounds within its object's.
  void add_surfaces(const CellContent& content, SplitFinder& finder) const {
    for (const auto& item : content.items()) {
      const auto tree = content.tree(item);
      const Aabb within = bounds_of(tree, model_.primitives);
      for (const TreeNode& n : tree) {
        if (n.size != 1) continue;
        finder.add(intersection_of(model_.primitives[n.primitive].bounds, within));
      }
    }
  }

  /// `room` is how many literals the leaf regions of the cell may hold. Halves get their parts of
  /// it by what they hold, so that no region is left whole because others were cut first.
  void subdivide(std::uint32_t node, const Aabb& cell, CellContent content, int depth,
                 double room) {
    if (content.items().empty() || depth >= options_.max_depth) {
      assembly_.close(node, cell, content);
      return;
    }
    SplitFinder finder(cell, 2 * model_.delta, options_.step_cost);
    add_surfaces(content, finder);
    const Split split = finder.best();
    if (!(split.cost < static_cast<double>(finder.count()))) {
      assembly_.close(node, cell, content);
      return;
    }
    Aabb lower = cell;
    lower.hi[split.axis] = split.at;
    Aabb upper = cell;
    upper.lo[split.axis] = split.at;
    CellContent below = restricted_to(content, model_, lower);
    CellContent above = restricted_to(content, model_, upper);
    const auto lower_count = static_cast<double>(below.literal_count());
    const double count = lower_count + static_cast<double>(above.literal_count());
    if (count > room) {
      assembly_.close(node, cell, content);
      return;
    }
    content = {};
    const std::uint32_t child = assembly_.cut(node, split.axis, split.at);
    const double lower_room = count > 0 ? room * lower_count / count : 0;
    subdivide(child, lower, std::move(below), depth + 1, lower_room);
    subdivide(child + 1, upper, std::move(above), depth + 1, room - lower_room);
  }

  const Model& model_;
  BspOptions options_;
  BspAssembly assembly_;
};

}  // namespace

Bsp Bsp::build(const Model& model, const BspOptions& options) {
  return BspBuilder(model, options).run(content_of(model));
}

Bsp Bsp::build_for_object(const Model& model, std::uint32_t object, const BspOptions& options) {
  return BspBuilder(model, options).run(content_of(model, object, object + 1));
}

std::size_t Bsp::memory_bytes() const {
  return nodes_.capacity() * sizeof(BspNode) + leaves_.capacity() * sizeof(BspLeaf) +
         store_.memory_bytes();
}

}  // namespace graycube
