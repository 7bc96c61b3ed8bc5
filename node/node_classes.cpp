// How a full node goes on (ARCHITECTURE.md, "Flow"). Where the outboxes hold all that they may,
// evaluators trace only rays that came on the credit of their classes, of one class at a time, and
// only while there is room for what may descend from them: its class is one higher. The highest
// class sends nothing on, so that every class finds room in the end.
#include <algorithm>
#include <utility>

#include "check.hpp"
#include "node/node.hpp"
#include "proto/control.hpp"

namespace graycube {

/// Rays that wait for another node's model are on their way to an outbox, or will be traced.
bool Node::is_full() const {
  return !is_blocking() && outbox_rays_ + rays_in_wait_ >= load_.outbox_rays;
}

/// Rays that one hit may send out: to each light, reflected and refracted.
std::uint32_t Node::most_children() const {
  return static_cast<std::uint32_t>(domain_->settings().lights.size()) + 2;
}

/// Rays on class credit that an evaluator of a full node traces together: for all classes, the room
/// for what they may send on is a quarter of the outboxes, or enough for one.
std::uint64_t Node::rays_per_class_work() const {
  const std::uint64_t classes = most_hops(limits_.max_depth, limits_.columns, limits_.rows);
  const std::uint64_t fitting = load_.outbox_rays / (4 * classes * load_.threads * most_children());
  return std::clamp<std::uint64_t>(fitting, 1, Evaluator::kWaveRays);
}

/// Whether the class outboxes have room for what rays of this class may send on.
bool Node::has_room_after(std::uint16_t of_class) const {
  const auto next = class_outbox_rays_.find(static_cast<std::uint16_t>(of_class + 1));
  if (next == class_outbox_rays_.end()) return true;
  return next->second <= (load_.threads - 1) * rays_per_class_work() * most_children();
}

bool Node::has_class_ray_to_take() const {
  if (class_rays_.is_empty()) return false;
  if (!is_full()) return true;
  // A ray may wait for a model instead of going to a class outbox; the model comes in any case.
  return rays_in_wait_ == 0 &&
         class_rays_.highest([this](std::uint16_t c) { return has_room_after(c); }).has_value();
}

/// Rays that came on class credit: while the node is full those of one class, otherwise any. Those
/// that only pass through go on at once. False when none is left to be traced.
bool Node::take_class_rays(Work& work) {
  if (!has_class_ray_to_take()) return false;
  const bool full = is_full();
  std::vector<std::vector<std::uint16_t>> taken(links_.size());
  RayWork batch;
  while (batch.rays.size() < (full ? rays_per_class_work() : kMaxRaysPerWork)) {
    const bool begun = full && !batch.rays.empty();
    const auto of_class = class_rays_.highest([&](std::uint16_t c) {
      return !full || (has_room_after(c) && (!begun || c == batch.rays.front().hops));
    });
    if (!of_class) break;
    const ClassStore::Held held = class_rays_.take(*of_class);
    if (held.link) taken[*held.link].push_back(*of_class);
    const std::span<const RayTask> ray{&held.ray, 1};
    if (domain_->holds(held.ray.region)) {
      batch.rays.push_back(held.ray);
    } else {
      leave(full ? of_class : std::nullopt, bit_towards(held.ray.region), ray);
    }
  }
  for (std::uint32_t bit = 0; bit < taken.size(); ++bit) give_back_classes(links_[bit], taken[bit]);
  if (batch.rays.empty()) return false;
  if (full) {
    work.on_class = batch.rays.front().hops;
    work.most_leaving = 1;
    class_outbox_rays_[static_cast<std::uint16_t>(*work.on_class + 1)] +=
        rays_per_class_work() * most_children();
  }
  work.what = std::move(batch);
  return true;
}

void Node::release_room_after(std::uint16_t of_class) {
  const auto next = class_outbox_rays_.find(static_cast<std::uint16_t>(of_class + 1));
  next->second -= rays_per_class_work() * most_children();
  if (next->second == 0) class_outbox_rays_.erase(next);
}

void Node::give_back_classes(Link& link, std::span<const std::uint16_t> classes) {
  if (classes.empty()) return;
  for (const std::uint16_t c : classes)
    GRAYCUBE_CHECK(link.places_in.give_back(c), "class %u held no place", c);
  outgoing_.push_back(
      {link.peer, Message::of_batch(encode_class_credit(stamp(link.next_sequence++), classes))});
}

/// Rays leave, of a class that a full node traces or of none.
void Node::leave(std::optional<std::uint16_t> on_class, std::uint32_t bit,
                 std::span<const RayTask> rays) {
  if (!on_class) return forward_across(bit, rays);
  count_forwarded(bit, rays);
  std::vector<RayTask>& outbox = links_[bit].class_outbox;
  outbox.insert(outbox.end(), rays.begin(), rays.end());
  for (RayTask& ray : std::span(outbox).last(rays.size())) {
    cross_link(ray);
    ++class_outbox_rays_[ray.hops];
  }
  outbox_rays_ += rays.size();
  stats_.outbox_peak = std::max(stats_.outbox_peak, outbox_rays_);
}

void Node::forget_class_ray(const RayTask& ray) {
  const auto count = class_outbox_rays_.find(ray.hops);
  if (--count->second == 0) class_outbox_rays_.erase(count);
  --outbox_rays_;
}

/// What descends from rays on class credit, as far as the link's own credit allows.
void Node::send_class_outbox(Link& link) {
  std::vector<RayTask>& waiting = link.class_outbox;
  const auto paid =
      std::min<std::size_t>({waiting.size(), link.send_credit / kRayBytes, kMaxRaysPerBatch});
  if (paid == 0) return;
  send_batch(link, std::span(waiting).first(paid));
  for (const RayTask& ray : std::span(waiting).first(paid)) forget_class_ray(ray);
  waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(paid));
}

/// Where there is no such credit: what descends from rays on class credit, and of a full node all
/// else, while there are places for their classes.
void Node::send_on_class(Link& link) {
  std::vector<RayTask> rays;
  std::erase_if(link.class_outbox, [&](const RayTask& ray) {
    if (rays.size() == kMaxRaysPerBatch || !link.places_out.take(ray.hops, load_.class_places)) {
      return false;
    }
    rays.push_back(ray);
    forget_class_ray(ray);
    return true;
  });
  while (is_full() && !link.outbox.is_empty() && rays.size() < kMaxRaysPerBatch &&
         link.places_out.take(link.outbox.oldest(1).front().hops, load_.class_places)) {
    rays.push_back(link.outbox.oldest(1).front());
    link.outbox.drop_oldest(1);
    --outbox_rays_;
  }
  if (!rays.empty()) send_batch(link, rays, BatchType::kClassRays);
}

void Node::on_class_rays(Link& link, std::uint32_t bit, std::span<const std::byte> batch) {
  std::vector<RayTask>& rays = received_;
  const auto result = decode_rays(batch, limits_, rays, BatchType::kClassRays);
  const auto* error = std::get_if<BatchError>(&result);
  const bool is_due =
      error == nullptr && std::all_of(rays.begin(), rays.end(), [&](const RayTask& ray) {
        return is_due_here(ray.region) && link.places_in.take(ray.hops, load_.class_places);
      });
  if (!is_due) {
    drop("class rays",
         error != nullptr ? to_string(*error) : "for another macro-region, or without credit");
    return send_control(control::NodeError{
        job_, "a broken batch of class rays came from node " + std::to_string(link.peer.value)});
  }
  ring_.message_received();
  stats_.rays_in += rays.size();
  for (const RayTask& ray : rays) class_rays_.add_received(ray, bit);
  note_queue();
}

void Node::on_class_credit(Link& link, std::span<const std::byte> batch) {
  std::vector<std::uint16_t> classes;
  const auto result = decode_class_credit(batch, limits_, classes);
  if (std::holds_alternative<BatchError>(result)) return drop("class credit", "malformed");
  for (const std::uint16_t c : classes) {
    if (!link.places_out.give_back(c)) drop("class credit", "of a class that it was not due for");
  }
  send_rays(link, all_evaluators_wait());
}

/// Rays on their way through this node.
void Node::pass_on(std::uint32_t from_bit, std::span<const RayTask> rays) {
  take_from(from_bit, rays.size());
  forward_across(bit_towards(rays.front().region), rays);
}

void Node::pass_on_what_waits() {
  while (!passing_.empty() && !is_full()) {
    pass_on(passing_.front().bit, passing_.front().rays);
    passing_.pop_front();
  }
}

}  // namespace graycube
