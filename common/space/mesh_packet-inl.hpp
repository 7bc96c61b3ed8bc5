// A mesh along the rays of a packet, which go through its tree together.
#if defined(GRAYCUBE_SPACE_MESH_PACKET_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAYCUBE_SPACE_MESH_PACKET_INL
#undef GRAYCUBE_SPACE_MESH_PACKET_INL
#else
#define GRAYCUBE_SPACE_MESH_PACKET_INL
#endif

#include <hwy/highway.h>

#include <optional>

#include "csg/mesh_walk-inl.hpp"
#include "space/packet_culling-inl.hpp"
#include "space/packet_nodes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

/// Finds what Mesh::crossings finds for each of some rays of a packet.
class MeshPacket {
 public:
  /// Calls visit(ray, t, entering) for the crossings of each ray in [t0, t1[ray]), in order, until it returns false;
  /// then for the next ray.
  template <typename Visit>
  static void crossings(const Mesh& mesh, const RayPacket& packet, const CullingPacket& p, Mask rays, const double* t1,
                        TreeScratch& scratch, Visit&& visit) {
    // What lies behind t1 matters to rays that may start within the mesh: all their cuts ahead tell whether they do.
    CullingPacket whole = p;
    std::array<std::optional<csg::MeshLine>, kRays> lines;
    std::array<Ray, kRays> singles;
    std::array<double, kRays> below;
    Mask outside = 0;
    for (Mask rest = rays; rest != 0; rest &= rest - 1) {
      const std::size_t i = first_ray(rest);
      singles[i] = packet.ray(i);
      lines[i].emplace(singles[i]);
      scratch.packet_cuts[i].clear();
      ++scratch.counts.primitives_tested;
      below[i] = csg::kInf;
      if (mesh.is_before_bounds(singles[i], packet.t0[i])) {
        outside |= Mask{1} << i;
        below[i] = t1[i];
      } else {
        whole.last[i] = std::numeric_limits<float>::infinity();
      }
    }
    whole.update_last_of_all();
    const MeshTree& tree = mesh.tree();
    const auto block = [&](std::uint32_t index, Mask met) {
      for (; met != 0; met &= met - 1) {
        const std::size_t i = first_ray(met);
        add_block_cuts(tree, index, *lines[i], singles[i], packet.t0[i], below[i], scratch.packet_cuts[i]);
      }
    };
    const auto walk = [&](std::uint32_t node, std::size_t i) {
      add_cuts_below(tree, node, whole.ray(i), whole.first[i], whole.last[i], *lines[i], singles[i], packet.t0[i],
                     below[i], scratch.packet_cuts[i]);
    };
    each_leaf_of_packet<Order::kAny>(tree.nodes(), whole, rays, scratch, block, walk);
    for (; rays != 0; rays &= rays - 1) {
      const std::size_t i = first_ray(rays);
      auto& cuts = scratch.packet_cuts[i];
      if (cuts.empty()) continue;
      Mesh::sort_by_parameter(cuts);
      const std::int32_t winding = (outside >> i & 1) != 0 ? 0 : Mesh::winding_before(cuts);
      Mesh::visit_crossings(cuts, winding, t1[i], [&](double t, bool entering) { return visit(i, t, entering); });
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#endif
