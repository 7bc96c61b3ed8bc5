#include "regions/slab_depths.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "check.hpp"
#include "regions/macro_grid.hpp"

namespace graycube {
namespace {

/// Boundaries lie at least so far from each other and from the eye, in scene units and in the
/// model's deltas, by which regions are grown.
constexpr double kLeastThickness = 1e-9, kLeastDeltas = 8;

struct DepthRange {
  double near, far;
};

double least_thickness(const Model& model) {
  return std::max(kLeastThickness, kLeastDeltas * model.delta);
}

/// The part in front of the eye of a box's depths; nothing if the box is unbounded, empty, or
/// behind the eye.
std::optional<DepthRange> depths_of(const Aabb& box, const CameraFrame& frame) {
  DepthRange range{0, 0};
  for (int axis = 0; axis < 3; ++axis) {
    const double lo = box.lo[axis] - frame.eye[axis], hi = box.hi[axis] - frame.eye[axis];
    if (!std::isfinite(lo) || !std::isfinite(hi) || lo > hi) return std::nullopt;
    const double along = frame.forward[axis];
    range.near += std::min(along * lo, along * hi);
    range.far += std::max(along * lo, along * hi);
  }
  if (!(range.far > 0)) return std::nullopt;
  range.near = std::max(range.near, 0.0);
  return range;
}

std::vector<double> middles_of_primitives(const Model& model, const CameraFrame& frame) {
  std::vector<double> middles;
  for (const Object& object : model.objects) {
    const auto whole = depths_of(object.bounds, frame);
    if (!whole) continue;
    for (const TreeNode& node : model.tree(object)) {
      if (node.size != 1) continue;
      const auto part = depths_of(model.primitives[node.primitive].bounds, frame).value_or(*whole);
      // What is cut away from an object may reach far beyond it.
      middles.push_back(0.5 * (std::clamp(part.near, whole->near, whole->far) +
                               std::clamp(part.far, whole->near, whole->far)));
    }
  }
  return middles;
}

}  // namespace

std::vector<double> even_slab_depths(const Model& model, const CameraFrame& frame,
                                     std::uint32_t slabs) {
  GRAYCUBE_CHECK(slabs >= 1 && slabs <= kMaxSlabs, "%u slabs", slabs);
  std::optional<DepthRange> all;
  for (const Object& object : model.objects) {
    const auto range = depths_of(object.bounds, frame);
    if (!range) continue;
    if (!all) all = range;
    all = DepthRange{std::min(all->near, range->near), std::max(all->far, range->far)};
  }
  const auto [near, far] = all.value_or(DepthRange{0, 1.0 * slabs});
  const double thickness = std::max((far - near) / slabs, least_thickness(model));
  std::vector<double> depths;
  for (std::uint32_t i = 1; i < slabs; ++i) depths.push_back(near + i * thickness);
  return depths;
}

std::vector<double> balanced_slab_depths(const Model& model, const CameraFrame& frame,
                                         std::uint32_t slabs) {
  std::vector<double> middles = middles_of_primitives(model, frame);
  if (middles.size() < slabs) return even_slab_depths(model, frame, slabs);
  std::sort(middles.begin(), middles.end());
  std::vector<double> depths;
  double last = 0;
  for (std::size_t i = 1; i < slabs; ++i) {
    const std::size_t first_beyond = i * middles.size() / slabs;
    const double depth = 0.5 * (middles[first_beyond - 1] + middles[first_beyond]);
    if (!(depth - last >= least_thickness(model))) return even_slab_depths(model, frame, slabs);
    depths.push_back(depth);
    last = depth;
  }
  return depths;
}

}  // namespace graycube
