#include "node/parts/ray_flow.hpp"

#include "node/parts/blocking_flow.hpp"
#include "node/parts/credit_flow.hpp"

namespace graycube {

FlowRules FlowRules::of(const control::Load& load, const Holding& here) {
  FlowRules rules;
  rules.links = here.seat.links();
  rules.link_credit_bytes = load.link_credit_bytes;
  rules.batch_bytes = load.batch_bytes;
  rules.outbox_rays = load.outbox_rays;
  rules.class_places = load.class_places;
  rules.classes =
      most_hops(here.limits.max_depth, here.limits.columns, here.limits.rows, here.limits.slabs);
  rules.threads = load.threads;
  // A hit sends a shadow ray to each light, a reflected and a refracted ray.
  rules.most_children = static_cast<std::uint32_t>(here.domain->settings().lights.size()) + 2;
  return rules;
}

void FlowCounts::count_forwarded(std::span<const RayTask> left) {
  for (const RayTask& ray : left) {
    switch (ray.kind) {
      case RayKind::kPrimary: ++forwarded_primary; break;
      case RayKind::kShadow: ++forwarded_shadow; break;
      case RayKind::kReflection:
      case RayKind::kRefraction: ++forwarded_secondary; break;
    }
  }
}

void FlowCounts::report(control::NodeStats& stats) const {
  stats.forwarded_shadow = forwarded_shadow;
  stats.forwarded_secondary = forwarded_secondary;
  stats.forwarded_primary = forwarded_primary;
  stats.ray_batches = batches;
  stats.ray_bytes = bytes;
  stats.rays_out = rays;
  stats.outbox_peak = outbox_peak;
}

void RayFlow::post_rays(std::uint32_t bit, std::span<const RayTask> rays, BatchType type,
                        FlowCounts& counts, Mail& mail) {
  if (light_back_ != nullptr) {
    numbered_.assign(rays.begin(), rays.end());
    if (!light_back_->leave(bit, numbered_)) return mail.fail_for_good(LightBack::kTooManyOpen);
    rays = numbered_;
  }
  ++counts.batches;
  counts.rays += rays.size();
  counts.bytes += mail.work_to_neighbour(
      bit, [&](const BatchStamp& stamp) { return encode_rays(stamp, rays, type); });
}

bool RayFlow::on_link_credit(std::uint32_t bit, std::span<const std::byte> batch,
                             const BatchLimits& limits, bool partial, Mail& mail) {
  std::uint64_t bytes = 0;
  const auto result = decode_link_credit(batch, limits, bytes);
  if (!std::holds_alternative<BatchError>(result)) return was_granted(bit, bytes, partial, mail);
  mail.drop("grant", "malformed");
  return false;
}

void RayFlow::on_class_credit(std::uint32_t bit, std::span<const std::byte> batch,
                              const BatchLimits& limits, bool partial, Mail& mail) {
  std::vector<std::uint16_t> classes;
  const auto result = decode_class_credit(batch, limits, classes);
  if (std::holds_alternative<BatchError>(result)) return mail.drop("class credit", "malformed");
  was_given_places(bit, classes, partial, mail);
}

std::unique_ptr<RayFlow> make_flow(FlowMode mode, const FlowRules& rules) {
  if (mode == FlowMode::kBlocking) return std::make_unique<BlockingFlow>(rules);
  return std::make_unique<CreditFlow>(rules);
}

}  // namespace graycube
