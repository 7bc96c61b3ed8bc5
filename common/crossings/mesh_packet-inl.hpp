// Finds a mesh's crossings with the rays of a packet, which go through the mesh's tree together.
#if defined(GRAYCUBE_SPACE_MESH_PACKET_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAYCUBE_SPACE_MESH_PACKET_INL
#undef GRAYCUBE_SPACE_MESH_PACKET_INL
#else
#define GRAYCUBE_SPACE_MESH_PACKET_INL
#endif

#include <hwy/highway.h>

#include <optional>

#include "crossings/packet_culling-inl.hpp"
#include "crossings/packet_nodes-inl.hpp"
#include "geometry/infinity.hpp"
#include "mesh/walk-inl.hpp"
#include "set_bits.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

/// Finds what Mesh::crossings finds for each of some rays of a packet.
class MeshPacket {
 public:
  /// `first_only`: only the first crossing of each ray is wanted.
  MeshPacket(const Mesh& mesh, const RayPacket& packet, const CullingPacket& p, Mask rays,
             const double* t1, bool first_only, TreeScratch& scratch)
      : mesh_(mesh), packet_(packet), rays_(rays), t1_(t1), scratch_(scratch), whole_(p) {
    const Aabb& box = mesh.bounds();
    const double size = max_abs(box.lo) + max_abs(box.hi);
    for (const std::size_t i : SetBits(rays)) {
      singles_[i] = packet.ray(i);
      lines_[i].emplace(singles_[i]);
      scratch.packet_cuts[i].clear();
      ++scratch.counts.primitives_tested;
      below_[i] = kInf;
      if (is_before(box, size, i, p)) {
        outside_ |= Mask{1} << i;
        below_[i] = t1[i];
      } else {
        // Cuts beyond t1 matter to a ray that may start within the mesh: all cuts ahead of it tell
        // whether it does.
        whole_.last[i] = kFloatInf;
      }
    }
    if (first_only) shortened_ = outside_;
    whole_.update_last_of_all();
  }

  /// Calls visit(ray, t, entering) for each ray's crossings in [t0, t1[ray]), in order, until it
  /// returns false, as it must at once with `first_only`; then goes on with the next ray.
  template <Order order, typename Visit>
  void crossings(Visit&& visit) {
    const auto block = [&](std::uint32_t index, Mask met) {
      for (const std::size_t i : SetBits(met)) {
        const std::size_t known = scratch_.packet_cuts[i].size();
        add_block_cuts(mesh_.tree(), index, *lines_[i], singles_[i], packet_.t0[i], below_[i],
                       scratch_.packet_cuts[i]);
        shorten(i, known);
      }
    };
    const auto walk = [&](std::uint32_t node, std::size_t i) {
      const std::size_t known = scratch_.packet_cuts[i].size();
      add_cuts_below(mesh_.tree(), node, whole_.ray(i), whole_.first[i], whole_.last[i], *lines_[i],
                     singles_[i], packet_.t0[i], below_[i], scratch_.packet_cuts[i]);
      shorten(i, known);
    };
    each_leaf_of_packet<order>(mesh_.tree().nodes(), whole_, rays_, scratch_, block, walk);
    for (const std::size_t i : SetBits(rays_)) {
      if (!scratch_.packet_cuts[i].empty()) visit_ray(i, visit);
    }
  }

 private:
  /// Like Mesh::is_before_bounds(), with the reciprocals given. A NaN, which a ray in a plane of
  /// the bounds gives, is ignored.
  bool is_before(const Aabb& box, double size, std::size_t i, const CullingPacket& p) const {
    const Ray& ray = singles_[i];
    const double margin = 1e-6 * (size + max_abs(ray.origin));
    double enter = -kInf;
    for (int a = 0; a < 3; ++a) {
      const double inverse = p.inverse[static_cast<std::size_t>(a)][i];
      const double at = inverse > 0 ? box.lo[a] - margin : box.hi[a] + margin;
      const double reached = (at - ray.origin[a]) * inverse;
      if (reached > enter) enter = reached;
    }
    return packet_.t0[i] < enter;
  }

  /// Ends a ray's search at the nearest of its cuts from number `known` on, if its first is enough.
  void shorten(std::size_t i, std::size_t known) {
    if ((shortened_ >> i & 1) == 0) return;
    const auto& cuts = scratch_.packet_cuts[i];
    double nearest = kInf;
    for (std::size_t k = known; k < cuts.size(); ++k) nearest = std::min(nearest, cuts[k].t);
    if (!(nearest < below_[i])) return;
    below_[i] = std::nextafter(nearest, kInf);
    whole_.last[i] = float_up(nearest);
    whole_.update_last_of_all();
  }

  template <typename Visit>
  void visit_ray(std::size_t i, Visit&& visit) {
    auto& cuts = scratch_.packet_cuts[i];
    Mesh::sort_by_parameter(cuts);
    const auto visit_one = [&](double t, bool entering) { return visit(i, t, entering); };
    if ((shortened_ >> i & 1) != 0 && !crosses_first(cuts)) {
      mesh_.crossings(singles_[i], packet_.t0[i], t1_[i], scratch_.cuts, visit_one);
      return;
    }
    const std::int32_t winding = (outside_ >> i & 1) != 0 ? 0 : Mesh::winding_before(cuts);
    Mesh::visit_crossings(cuts, winding, t1_[i], visit_one);
  }

  /// Whether the first cut is a crossing: not if faces that touch there cancel each other.
  static bool crosses_first(const std::vector<MeshCut>& cuts) {
    std::int32_t sum = 0;
    for (std::size_t k = 0; k < cuts.size() && cuts[k].t == cuts[0].t; ++k) sum += cuts[k].count;
    return sum != 0;
  }

  const Mesh& mesh_;
  const RayPacket& packet_;
  const Mask rays_;
  const double* t1_;
  TreeScratch& scratch_;
  CullingPacket whole_;
  std::array<std::optional<csg::MeshLine>, kRays> lines_;
  std::array<Ray, kRays> singles_;
  std::array<double, kRays> below_;
  /// Rays that start outside the mesh, and those of them whose first crossing alone is wanted.
  Mask outside_ = 0, shortened_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#endif
