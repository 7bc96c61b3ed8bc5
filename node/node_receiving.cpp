// What a node's brain does with its neighbours' batches.
#include <algorithm>

#include "check.hpp"
#include "node/node.hpp"
#include "proto/control.hpp"

namespace graycube {

void Node::on_neighbour(std::span<const std::byte> batch) {
  const auto peeked = peek_header(batch);
  if (const auto* error = std::get_if<BatchError>(&peeked)) {
    return drop("batch", to_string(*error));
  }
  const auto& header = std::get<BatchHeader>(peeked);
  if (!cube_) {
    // A neighbour may have heard the frontal's welcome first. Anything else is for a dead
    // predecessor.
    const bool keep =
        header.type == BatchType::kGreeting && early_greetings_.size() < kMaxDimension;
    if (keep) early_greetings_.emplace_back(batch.begin(), batch.end());
    return;
  }
  const std::uint32_t bit = bit_of(Rank{header.stamp.sender});
  if (bit >= links_.size()) return drop("batch", "not from a neighbour");
  Link& link = links_[bit];
  if (header.type == BatchType::kGreeting || header.type == BatchType::kGreetingAck) {
    return on_signal(link, header);
  }
  const BatchStamp& s = header.stamp;
  const bool stale = s.job != job_ || s.epoch != epoch_ || !plan_ ||
                     (!incarnations_.empty() && incarnations_.size() > s.sender &&
                      incarnations_[s.sender] != s.incarnation);
  if (stale) return;
  if (s.sequence != link.expected_sequence++) {
    return send_control(control::NodeError{
        job_, "a batch from node " + std::to_string(s.sender) + " was lost on its link"});
  }
  if (header.type == BatchType::kRays) return on_rays(link, bit, batch, header);
  if (header.type == BatchType::kClassRays) return on_class_rays(link, bit, batch);
  if (header.type == BatchType::kClassCredit) return on_class_credit(link, batch);
  if (header.type == BatchType::kContributions) return on_sums(link, batch);
  if (header.type == BatchType::kAssignment) return on_tiles(link, batch);
  if (header.type == BatchType::kIdle) return on_offer(link, batch, Link::Offer::kIdle);
  if (header.type == BatchType::kIdleWithCopy)
    return on_offer(link, batch, Link::Offer::kIdleWithCopy);
  if (header.type == BatchType::kLinkCredit) {
    std::uint64_t bytes = 0;
    const auto result = decode_link_credit(batch, limits_, bytes);
    if (std::holds_alternative<BatchError>(result)) return drop("grant", "malformed");
    link.send_credit += bytes;
    link.received += bytes;
    if (is_blocking()) return send_stalled();
    // Where all evaluators wait, none will come by to send the rest.
    return send_rays(link, all_evaluators_wait());
  }
  if (header.type == BatchType::kToken) {
    TokenRecord r;
    const auto result = decode_token(batch, limits_, r);
    if (std::holds_alternative<BatchError>(result)) return drop("token", "malformed");
    if (!ring_.token_arrived({r.black, r.count, r.round, r.hops, r.contribution_batches})) {
      return drop("token", "none was due");
    }
    if (id_.rank.value == 0) {
      send_control(control::TokenRound{job_, epoch_, r.round, r.hops, r.black, r.count});
    }
    return pass_token();
  }
  drop("batch", to_string(header.type));
}

void Node::on_rays(Link& link, std::uint32_t bit, std::span<const std::byte> batch,
                   const BatchHeader& header) {
  std::vector<RayTask>& rays = received_;
  const auto result = decode_rays(batch, limits_, rays);
  if (const auto* error = std::get_if<BatchError>(&result)) {
    // A broken batch can't be repaired, and what was in it is missing from the picture.
    drop("rays", to_string(*error));
    return send_control(control::NodeError{
        job_, "a broken batch of rays came from node " + std::to_string(link.peer.value)});
  }
  // Or the sender's own, for whom this node is to trace them; or a neighbour's: what left a copy of
  // another neighbour's regions comes this way.
  const auto is_senders = [&](RegionIndex region) { return owner_of(region) == link.peer; };
  const bool is_help = !rays.empty() && is_senders(rays.front().region);
  bool is_due = !is_help || copies_[bit] != nullptr;
  for_each_region(rays, [&](RegionIndex region, std::span<const RayTask>) {
    is_due = is_due && (is_help ? is_senders(region) : is_due_here(region));
  });
  if (!is_due) {
    drop("rays", "for another macro-region");
    return send_control(control::NodeError{
        job_, "node " + std::to_string(link.peer.value) + " sent rays for another node"});
  }
  ring_.message_received();
  stats_.rays_in += header.count;
  if (is_help) {
    stats_.rays_taken_over += rays.size();
    link.has_offered = false;
    helped_.push_back({link.peer, std::move(rays)});
    return note_queue();
  }
  const std::uint64_t outbox_before = outbox_rays_;
  for_each_region(rays, [&](RegionIndex region, std::span<const RayTask> run) {
    if (domain_->holds(region)) return rays_.add(run, bit);
    if (is_full()) return passing_.push_back({bit, {run.begin(), run.end()}});
    pass_on(bit, run);
  });
  note_queue();
  share_work();
  if (outbox_rays_ == outbox_before) return;
  if (all_evaluators_wait()) return flush_on_idle();
  for (Link& l : links_) send_rays(l, false);
  grant_credit(link, half_credit());
}

/// A ray for a region of this node; or on its way through it, from a helper to a neighbour of this
/// node or, where rays are finished that have left their macro-regions, from these to what they
/// meet.
bool Node::is_due_here(const RegionIndex& region) const {
  return domain_->holds(region) || domain_->has_foreign_bounds() ||
         (load_.makes_copies && bit_of(owner_of(region)) < links_.size());
}

void Node::note_queue() {
  std::size_t held = rays_.size() + class_rays_.size();
  for (const Helped& h : helped_) held += h.is_received ? h.rays.size() : 0;
  for (const Passing& p : passing_) held += p.rays.size();
  stats_.queue_peak = std::max<std::uint64_t>(stats_.queue_peak, held);
}

/// Light that a child in the tree of sums has gathered. It goes on with this node's own, at the
/// latest when nobody here is at work.
void Node::on_sums(const Link& link, std::span<const std::byte> batch) {
  BatchLimits limits = limits_;
  limits.pixel_count *= 1 + kAovPlanes;
  std::vector<TileCredit> credits;
  std::vector<Contribution> contributions;
  const auto result = decode_contributions(batch, limits, credits, contributions);
  const auto* error = std::get_if<BatchError>(&result);
  const bool is_child = has_children_ && cube_->tree_parent(link.peer) == id_.rank;
  if (error != nullptr || !is_child || credits.size() > MergeBuffer::kMostPixels ||
      contributions.size() > MergeBuffer::kMostPixels) {
    drop("contributions", error != nullptr ? to_string(*error) : "not a child's, or too many");
    return send_control(control::NodeError{
        job_, "a broken batch of contributions came from node " + std::to_string(link.peer.value)});
  }
  ring_.message_received();
  if (!merge_.add_gathered(credits, contributions)) {
    flush_contributions();
    GRAYCUBE_CHECK(merge_.add_gathered(credits, contributions), "no room in an empty buffer");
  }
  holds_others_light_ = true;
  if (merge_.is_full()) flush_contributions();
}

void Node::on_signal(Link& link, const BatchHeader& header) {
  if (header.type == BatchType::kGreeting) {
    outgoing_.push_back(
        {link.peer, Message::of_batch(encode_signal(stamp(0), BatchType::kGreetingAck))});
  }
  link.is_greeted = true;
  send_ready_when_complete();
}

}  // namespace graycube
