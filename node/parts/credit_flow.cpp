#include "node/parts/credit_flow.hpp"

#include <algorithm>
#include <utility>

#include "check.hpp"
#include "trace/step.hpp"

namespace graycube {
namespace {

/// A part of a batch goes out at once, 1 in kEagerPart, when at most 1 in kQuietPart of the link's
/// credit is out.
constexpr std::size_t kEagerPart = 4, kQuietPart = 8;
/// No primary rays are started while that many rays wait to be sent.
constexpr std::uint64_t kLongOutboxes = 8192;

}  // namespace

CreditFlow::CreditFlow(const FlowRules& rules) : rules_(rules), links_(rules.links) {
  CreditFlow::reset();
}

void CreditFlow::reset() {
  RayFlow::reset();
  for (Link& link : links_) link.reset(rules_.link_credit_bytes);
  outbox_rays_ = 0;
  class_rays_.clear();
  class_outbox_rays_.clear();
  passing_.clear();
}

Pace CreditFlow::pace() const {
  Pace pace;
  pace.most_leaving = std::max<std::uint64_t>(1, rules_.outbox_rays / kWorksPerOutboxes);
  return pace;
}

bool CreditFlow::is_full() const { return outbox_rays_ + reserved() >= rules_.outbox_rays; }

/// Tiles may wait: received rays are traced in any case, so the neighbours' inboxes empty
/// themselves, and with them the outboxes here.
bool CreditFlow::may_start_tiles() const { return outbox_rays_ < kLongOutboxes && !is_full(); }

std::size_t CreditFlow::held() const {
  std::size_t held = class_rays_.size();
  for (const Passing& p : passing_) held += p.rays.size();
  return held;
}

bool CreditFlow::is_empty() const {
  return RayFlow::is_empty() && outbox_rays_ == 0 && class_rays_.is_empty() && passing_.empty();
}

// ---- rays out

void CreditFlow::leave(std::uint32_t bit, std::span<const RayTask> rays,
                       std::optional<std::uint16_t> on_class) {
  GRAYCUBE_CHECK(bit < links_.size(), "a ray left for a node that is no neighbour");
  counts_.count_forwarded(rays);
  outbox_rays_ += rays.size();
  note_outbox();
  if (!on_class) return links_[bit].outbox.add(rays);
  std::vector<RayTask>& outbox = links_[bit].class_outbox;
  outbox.insert(outbox.end(), rays.begin(), rays.end());
  for (RayTask& ray : std::span(outbox).last(rays.size())) {
    cross_link(ray);
    ++class_outbox_rays_[ray.hops];
  }
}

bool CreditFlow::pass_on(std::uint32_t from_bit, std::uint32_t to_bit,
                         std::span<const RayTask> rays) {
  if (is_full()) {
    passing_.push_back({from_bit, to_bit, {rays.begin(), rays.end()}});
    return false;
  }
  taken(from_bit, rays.size());
  leave(to_bit, rays, std::nullopt);
  return true;
}

void CreditFlow::pass_on_what_waits() {
  while (!passing_.empty() && !is_full()) {
    const Passing first = std::move(passing_.front());
    passing_.pop_front();
    pass_on(first.from_bit, first.to_bit, first.rays);
  }
}

bool CreditFlow::send(bool partial, Mail& mail) {
  for (std::uint32_t bit = 0; bit < links_.size(); ++bit) send_link(bit, partial, mail);
  return false;
}

void CreditFlow::flush(Mail& mail) {
  for (std::uint32_t bit = 0; bit < links_.size(); ++bit) {
    send_link(bit, true, mail);
    // A smaller grant waits for next time: the peer has credit left, and each grant is a message.
    grant_from(bit, rules_.link_credit_bytes / kQuietPart, mail);
  }
}

/// Sends what the link's credit allows: full batches, and with `partial`, or while nothing is under
/// way on the link, smaller ones.
void CreditFlow::send_link(std::uint32_t bit, bool partial, Mail& mail) {
  Link& link = links_[bit];
  send_class_outbox(bit, mail);
  const std::size_t full =
      std::clamp<std::size_t>(rules_.batch_bytes / kRayBytes, 1, kMaxRaysPerBatch);
  for (;;) {
    const std::size_t waiting = link.outbox.size();
    const std::size_t count = std::min({waiting, gift_room(bit), full});
    const std::uint64_t under_way = rules_.link_credit_bytes - link.send_credit;
    const bool eager =
        kQuietPart * under_way <= rules_.link_credit_bytes && kEagerPart * waiting >= full;
    if (count == 0 || (count < full && !partial && !eager)) break;
    give(bit, link.outbox.oldest(count), mail);
    link.outbox.drop_oldest(count);
    outbox_rays_ -= count;
  }
  if (link.send_credit < kRayBytes && (is_full() || !link.class_outbox.empty()))
    send_on_class(bit, mail);
}

void CreditFlow::give(std::uint32_t bit, std::span<const RayTask> rays, Mail& mail) {
  links_[bit].send_credit -= rays.size() * kRayBytes;
  post_rays(bit, rays, BatchType::kRays, counts_, mail);
}

std::size_t CreditFlow::gift_room(std::uint32_t bit) const {
  return static_cast<std::size_t>(links_[bit].send_credit / kRayBytes);
}

/// Sends rays that descend from rays on class credit, as far as the link's own credit allows.
void CreditFlow::send_class_outbox(std::uint32_t bit, Mail& mail) {
  std::vector<RayTask>& waiting = links_[bit].class_outbox;
  const auto paid = std::min<std::size_t>({waiting.size(), gift_room(bit), kMaxRaysPerBatch});
  if (paid == 0) return;
  give(bit, std::span(waiting).first(paid), mail);
  for (const RayTask& ray : std::span(waiting).first(paid)) forget_class_ray(ray);
  waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(paid));
}

/// Sends rays on their classes' places when the link has no credit: those that descend from rays on
/// class credit, and if the node is full all others, too.
void CreditFlow::send_on_class(std::uint32_t bit, Mail& mail) {
  Link& link = links_[bit];
  std::vector<RayTask> rays;
  std::erase_if(link.class_outbox, [&](const RayTask& ray) {
    if (rays.size() == kMaxRaysPerBatch || !link.places_out.take(ray.hops, rules_.class_places))
      return false;
    rays.push_back(ray);
    forget_class_ray(ray);
    return true;
  });
  while (is_full() && !link.outbox.is_empty() && rays.size() < kMaxRaysPerBatch &&
         link.places_out.take(link.outbox.oldest(1).front().hops, rules_.class_places)) {
    rays.push_back(link.outbox.oldest(1).front());
    link.outbox.drop_oldest(1);
    --outbox_rays_;
  }
  if (!rays.empty()) post_rays(bit, rays, BatchType::kClassRays, counts_, mail);
}

void CreditFlow::forget_class_ray(const RayTask& ray) {
  const auto count = class_outbox_rays_.find(ray.hops);
  if (--count->second == 0) class_outbox_rays_.erase(count);
  --outbox_rays_;
}

// ---- credit

void CreditFlow::taken(std::uint32_t bit, std::size_t rays) {
  links_[bit].ungranted += rays * kRayBytes;
}

/// A node at work gives back half of a link's credit at once.
void CreditFlow::grant(std::uint32_t bit, Mail& mail) {
  grant_from(bit, rules_.link_credit_bytes / 2, mail);
}

void CreditFlow::grant_from(std::uint32_t bit, std::uint64_t least, Mail& mail) {
  Link& link = links_[bit];
  if (link.ungranted == 0 || link.ungranted < least) return;
  mail.to_neighbour(
      bit, [&](const BatchStamp& stamp) { return encode_link_credit(stamp, link.ungranted); });
  link.ungranted = 0;
}

bool CreditFlow::was_granted(std::uint32_t bit, std::uint64_t bytes, bool partial, Mail& mail) {
  links_[bit].send_credit += bytes;
  send_link(bit, partial, mail);
  return false;
}

// ---- rays on the credit of their classes

/// The most rays that an evaluator of a full node may send on in one piece of work.
std::uint64_t CreditFlow::children_per_class_work() const {
  return rays_per_class_work() * rules_.most_children;
}

/// Rays on class credit that an evaluator of a full node traces together: for all classes, the room
/// for what they may send on is a quarter of the outboxes, or enough for one.
std::uint64_t CreditFlow::rays_per_class_work() const {
  const std::uint64_t fitting =
      rules_.outbox_rays / (4 * rules_.classes * rules_.threads * rules_.most_children);
  return std::clamp<std::uint64_t>(fitting, 1, Evaluator::kWaveRays);
}

/// Whether the class outboxes have room for what rays of this class may send on.
bool CreditFlow::has_room_after(std::uint16_t of_class) const {
  const auto next = class_outbox_rays_.find(static_cast<std::uint16_t>(of_class + 1));
  if (next == class_outbox_rays_.end()) return true;
  return next->second <= (rules_.threads - 1) * children_per_class_work();
}

bool CreditFlow::has_class_work() const {
  if (class_rays_.is_empty()) return false;
  if (!is_full()) return true;
  // A ray may wait for a model instead of going to a class outbox; the model comes in any case.
  return reserved() == 0 && next_class(true, {}).has_value();
}

/// The highest class that may be taken. A full node takes only classes that have room for children,
/// and only that of the rays in `begun`, if there are any.
std::optional<std::uint16_t> CreditFlow::next_class(bool is_full,
                                                    const std::vector<RayTask>& begun) const {
  return class_rays_.highest([&](std::uint16_t c) {
    return !is_full || (has_room_after(c) && (begun.empty() || c == begun.front().hops));
  });
}

/// Takes rays of one class while the node is full, otherwise of any.
std::optional<RayFlow::ClassWork> CreditFlow::take_class_work(const Route& route, Mail& mail) {
  if (!has_class_work()) return std::nullopt;
  const bool full = is_full();
  std::vector<std::vector<std::uint16_t>> taken(links_.size());
  ClassWork work;
  while (work.rays.size() < (full ? rays_per_class_work() : kMaxRaysPerWork)) {
    const auto of_class = next_class(full, work.rays);
    if (!of_class) break;
    const ClassStore::Held held = class_rays_.take(*of_class);
    if (held.link) taken[*held.link].push_back(*of_class);
    if (const auto bit = route(held.ray.region)) {
      leave(*bit, {&held.ray, 1}, full ? of_class : std::nullopt);
    } else {
      work.rays.push_back(held.ray);
    }
  }
  for (std::uint32_t bit = 0; bit < taken.size(); ++bit) give_back_classes(bit, taken[bit], mail);
  if (work.rays.empty()) return std::nullopt;
  if (full) {
    work.on_class = work.rays.front().hops;
    class_outbox_rays_[static_cast<std::uint16_t>(*work.on_class + 1)] += children_per_class_work();
  }
  return work;
}

void CreditFlow::class_work_ended(std::uint16_t on_class, std::span<const RayTask> set_aside) {
  const auto next = class_outbox_rays_.find(static_cast<std::uint16_t>(on_class + 1));
  next->second -= children_per_class_work();
  if (next->second == 0) class_outbox_rays_.erase(next);
  class_rays_.add_own(set_aside);
}

void CreditFlow::give_back_classes(std::uint32_t bit, std::span<const std::uint16_t> classes,
                                   Mail& mail) {
  if (classes.empty()) return;
  for (const std::uint16_t c : classes) {
    GRAYCUBE_CHECK(links_[bit].places_in.give_back(c), "class %u held no place", c);
  }
  mail.to_neighbour(bit,
                    [&](const BatchStamp& stamp) { return encode_class_credit(stamp, classes); });
}

bool CreditFlow::add_class_rays(std::uint32_t bit, std::span<const RayTask> rays) {
  for (const RayTask& ray : rays) {
    if (!links_[bit].places_in.take(ray.hops, rules_.class_places)) return false;
  }
  for (const RayTask& ray : rays) class_rays_.add_received(ray, bit);
  return true;
}

void CreditFlow::was_given_places(std::uint32_t bit, std::span<const std::uint16_t> classes,
                                  bool partial, Mail& mail) {
  for (const std::uint16_t c : classes) {
    if (!links_[bit].places_out.give_back(c))
      mail.drop("class credit", "of a class that it was not due for");
  }
  send_link(bit, partial, mail);
}

}  // namespace graycube
