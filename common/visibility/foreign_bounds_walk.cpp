// Takes packets of rays through foreign bounds.
#include "geometry/simd.hpp"
#include "visibility/foreign_bounds.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "visibility/foreign_bounds_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "crossings/packet_nodes-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

Mask MayMeet(const std::vector<WideNode>& nodes, const RayPacket& packet, TreeScratch& scratch) {
  const CullingPacket p(packet);
  const Mask all = packet.all();
  Mask meets_none = all;
  const auto leaf = [&](std::uint32_t, Mask rays) { meets_none &= ~rays; };
  const auto walk = [&](std::uint32_t node, std::size_t i) {
    const auto met = [&](std::uint32_t) {
      meets_none &= ~(Mask{1} << i);
      return false;
    };
    each_item_below<Order::kAny>(
        nodes, node, p.ray(i), p.first[i], [&] { return packet.t1[i]; }, scratch, met);
  };
  each_leaf_of_packet<Order::kAny>(nodes, p, meets_none, scratch, leaf, walk);
  return all & ~meets_none;
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace graycube {

GRAYCUBE_SIMD_TABLE(MayMeet);

RayPacket::Mask ForeignBounds::may_meet(const RayPacket& packet, TreeScratch& scratch) const {
  if (packet.count == 0 || nodes_.empty()) return 0;
  return GRAYCUBE_SIMD_CALL(MayMeet)(nodes_, packet, scratch);
}

}  // namespace graycube
#endif
