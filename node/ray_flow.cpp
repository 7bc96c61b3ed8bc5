#include "node/ray_flow.hpp"

#include "node/blocking_flow.hpp"
#include "node/credit_flow.hpp"

namespace graycube {

void FlowCounts::count_forwarded(std::span<const RayTask> left) {
  for (const RayTask& ray : left) ++(ray.kind == RayKind::kShadow ? forwarded_shadow : forwarded_secondary);
}

void FlowCounts::report(control::NodeStats& stats) const {
  stats.forwarded_shadow = forwarded_shadow;
  stats.forwarded_secondary = forwarded_secondary;
  stats.ray_batches = batches;
  stats.ray_bytes = bytes;
  stats.rays_out = rays;
  stats.outbox_peak = outbox_peak;
}

void RayFlow::post_rays(std::uint32_t bit, std::span<const RayTask> rays, BatchType type, FlowCounts& counts,
                        Mail& mail) {
  ++counts.batches;
  counts.rays += rays.size();
  counts.bytes += mail.work_to_neighbour(
      bit, [&](const BatchStamp& stamp) { return encode_rays(stamp, rays, type); });
}

std::unique_ptr<RayFlow> make_flow(FlowMode mode, const FlowRules& rules) {
  if (mode == FlowMode::kBlocking) return std::make_unique<BlockingFlow>(rules);
  return std::make_unique<CreditFlow>(rules);
}

}  // namespace graycube
