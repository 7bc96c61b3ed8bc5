#include "node/parts/blocking_flow.hpp"

#include <algorithm>
#include <utility>

#include "check.hpp"

namespace graycube {

BlockingFlow::BlockingFlow(const FlowRules& rules)
    : link_credit_(rules.link_credit_bytes), links_(rules.links) {
  BlockingFlow::reset();
}

void BlockingFlow::reset() {
  RayFlow::reset();
  stalled_.clear();
  for (Link& link : links_) link = {link_credit_, 0, 0, 0};
}

Pace BlockingFlow::pace() const {
  Pace pace;
  pace.most_rays = 1;
  pace.is_one_by_one = true;
  pace.token_never_rests = true;
  return pace;
}

void BlockingFlow::leave(std::uint32_t bit, std::span<const RayTask> rays,
                         std::optional<std::uint16_t>) {
  GRAYCUBE_CHECK(bit < links_.size(), "a ray left for a node that is no neighbour");
  counts_.count_forwarded(rays);
  for (const RayTask& ray : rays) stalled_.push_back({ray, bit});
  counts_.outbox_peak = std::max<std::uint64_t>(counts_.outbox_peak, stalled_.size());
}

bool BlockingFlow::pass_on(std::uint32_t from_bit, std::uint32_t to_bit,
                           std::span<const RayTask> rays) {
  taken(from_bit, rays.size());
  leave(to_bit, rays, std::nullopt);
  return false;
}

bool BlockingFlow::send(bool, Mail& mail) {
  const bool was_stalled = is_stalled();
  while (is_stalled() && links_[stalled_.front().bit].send_credit >= kRayBytes) {
    const Stalled first = stalled_.front();
    stalled_.pop_front();
    give(first.bit, {&first.ray, 1}, mail);
  }
  return was_stalled && !is_stalled();
}

void BlockingFlow::flush(Mail& mail) {
  for (std::uint32_t bit = 0; bit < links_.size(); ++bit) grant(bit, mail);
}

void BlockingFlow::give(std::uint32_t bit, std::span<const RayTask> rays, Mail& mail) {
  links_[bit].send_credit -= rays.size() * kRayBytes;
  post_rays(bit, rays, BatchType::kRays, counts_, mail);
}

std::size_t BlockingFlow::gift_room(std::uint32_t bit) const {
  return static_cast<std::size_t>(links_[bit].send_credit / kRayBytes);
}

void BlockingFlow::taken(std::uint32_t bit, std::size_t rays) {
  links_[bit].ungranted += rays * kRayBytes;
}

void BlockingFlow::grant(std::uint32_t bit, Mail& mail) {
  Link& link = links_[bit];
  if (link.ungranted == 0) return;
  mail.to_neighbour(
      bit, [&](const BatchStamp& stamp) { return encode_link_credit(stamp, link.ungranted); });
  link.granted += std::exchange(link.ungranted, 0);
}

bool BlockingFlow::was_granted(std::uint32_t bit, std::uint64_t bytes, bool partial, Mail& mail) {
  links_[bit].send_credit += bytes;
  links_[bit].received += bytes;
  return send(partial, mail);
}

void BlockingFlow::answer_ping(std::uint64_t ping, Mail& mail) const {
  control::WaitReport report;
  report.job = mail.job();
  report.epoch = mail.epoch();
  report.ping = ping;
  report.is_stalled = is_stalled();
  report.moves = moves_;
  if (is_stalled()) report.waits_for = stalled_.front().bit;
  for (const Link& link : links_) {
    report.granted.push_back(link.granted);
    report.received.push_back(link.received);
  }
  mail.to_frontal(report);
}

}  // namespace graycube
