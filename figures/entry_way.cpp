#include "figures/entry_way.hpp"

#include <cmath>
#include <map>
#include <span>
#include <tuple>
#include <variant>

#include "proto/model_slice.hpp"
#include "subdivisions/frustum_order.hpp"
#include "subdivisions/leaf_entry.hpp"

namespace graycube::figures {
namespace {

template <typename Order>
std::vector<std::uint32_t> way_along(const LeafSpace& space, const Order& order, double t) {
  std::vector<std::uint32_t> way;
  WalkCounts counts;
  OutermostLeaves(space.bsp()).enter(space.bsp(), order, t, counts, [&](const BspLeaf& leaf) {
    way.push_back(space.node_of(leaf));
  });
  return way;
}

/// The subdivided parts of the scene that nodes hold, made when first asked for.
class NodeSpaces {
 public:
  struct Part {
    std::shared_ptr<const Model> model;
    std::shared_ptr<const LeafSpace> space;
  };

  NodeSpaces(const std::vector<SharedBytes>& slices, Subdivision way)
      : slices_(slices), way_(way) {}

  /// Nothing when the node's part is empty.
  const Part& of(Rank rank) {
    const std::uint32_t i = slices_.size() > 1 ? rank.value : 0;
    const auto [found, is_new] = parts_.try_emplace(i);
    if (!is_new || i >= slices_.size()) return found->second;
    std::span<const std::byte> bytes = slices_[i].bytes();
    auto taken = take_model(bytes);
    if (auto* model = std::get_if<Model>(&taken)) {
      found->second.model = std::make_shared<const Model>(std::move(*model));
      found->second.space = std::make_shared<const LeafSpace>(*found->second.model, way_);
    }
    return found->second;
  }

 private:
  const std::vector<SharedBytes>& slices_;
  Subdivision way_;
  std::map<std::uint32_t, Part> parts_;
};

/// Rays that begin in a macro-region other than their node's come from nowhere: they have no way
/// behind them, of more than this share of a unit.
constexpr double kLeastWay = 1e-6;

bool can_be_drawn(const LeafSpace& space, const RayTask& ray) {
  if (!(ray.t > kLeastWay)) return false;
  if (space.way() != Subdivision::kArnaldi) return true;
  const Ray line = space.camera_space().line_of(ray.ray);
  return !space.is_fan() || line.origin.z + ray.t * line.direction.z > 0;
}

/// What makes a way worth drawing, the most important first: that it is legible and long, and ends
/// amid the scene, in a leaf region that holds something; then how far the ray has come.
using Merit = std::tuple<bool, std::size_t, int, bool, double>;

Merit merit_of(const LeafSpace& space, const std::vector<std::uint32_t>& way, const RayTask& ray) {
  const Aabb& cell = space.cell(way.back());
  int finite_faces = 0;
  for (int a = 0; a < 3; ++a) {
    finite_faces += (std::isfinite(cell.lo[a]) ? 1 : 0) + (std::isfinite(cell.hi[a]) ? 1 : 0);
  }
  return {way.size() <= kMostOnWay, way.size(), finite_faces,
          !space.primitives_below(way.back()).empty(), ray.t};
}

}  // namespace

std::vector<std::uint32_t> entry_way(const LeafSpace& space, const RayTask& ray) {
  if (space.way() == Subdivision::kArnaldi) {
    return way_along(space, FrustumOrder(space.camera_space(), ray.ray), ray.t);
  }
  return way_along(space, PlaneOrder(ray.ray), ray.t);
}

std::uint32_t subtree_between(const LeafSpace& space, std::uint32_t leaf, std::uint32_t next) {
  // The first face in the order of OutermostLeaves behind which the next leaf region lies.
  const BspLeaf& region = space.bsp().leaves()[space.bsp().nodes()[leaf].child];
  const Aabb& cell = space.cell(next);
  for (const std::uint32_t node : region.neighbour) {
    if (node != kNoNeighbour && intersection_of(space.cell(node), cell) == cell) return node;
  }
  return next;
}

std::optional<ShownEntry> choose_entry(const RunRecord& run, const std::vector<SharedBytes>& slices,
                                       Subdivision way) {
  NodeSpaces spaces(slices, way);
  std::optional<ShownEntry> best;
  Merit best_merit;
  for (const ReceivedRay& received : run.rays) {
    const NodeSpaces::Part& part = spaces.of(received.at);
    if (!part.space || !can_be_drawn(*part.space, received.ray)) continue;
    auto passed = entry_way(*part.space, received.ray);
    const Merit merit = merit_of(*part.space, passed, received.ray);
    if (best && merit <= best_merit) continue;
    best = ShownEntry{received, part.model, part.space, std::move(passed)};
    best_merit = merit;
  }
  return best;
}

}  // namespace graycube::figures
