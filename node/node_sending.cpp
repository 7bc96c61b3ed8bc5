// What a node's brain sends, and when: rays, grants of credit, contributions, the token.
#include <algorithm>
#include <utility>

#include "check.hpp"
#include "node/node.hpp"
#include "proto/control.hpp"

namespace graycube {
namespace {

/// Where little is under way on a link, a part of a batch goes out at once: this part, when at most
/// that part of the link's credit is out.
constexpr std::size_t kEagerPart = 4, kQuietPart = 8;
/// A batch may be slow while the token goes round quickly, so after so many white rounds with the
/// same non-zero sum each further one waits for the frontal's next ping.
constexpr std::uint32_t kFreeStalledRounds = 1;
/// Of all rounds so many are free. Once all tiles are whole two more are enough, and until then
/// they mostly find rays under way: the others wait for that, or (a batch may be lost) for one of
/// so many pings.
constexpr std::uint32_t kFreeRounds = 2;
constexpr std::uint64_t kPingsToARound = 8;

}  // namespace

BatchStamp Node::stamp(std::uint64_t sequence) const {
  return {job_, epoch_, id_.rank.value, id_.incarnation, sequence};
}

void Node::send_control(const ControlMessage& message) {
  outgoing_.push_back({std::nullopt, Message::of_text(encode(message))});
}

/// Sends what the link's credit allows: full batches, and with `partial`, or while nothing is under
/// way on the link, smaller ones.
void Node::send_rays(Link& link, bool partial) {
  send_class_outbox(link);
  const std::size_t full =
      std::clamp<std::size_t>(load_.batch_bytes / kRayBytes, 1, kMaxRaysPerBatch);
  for (;;) {
    const std::size_t waiting = link.outbox.size();
    const std::size_t allowed = static_cast<std::size_t>(link.send_credit / kRayBytes);
    const std::size_t count = std::min({waiting, allowed, full});
    const std::uint64_t under_way = load_.link_credit_bytes - link.send_credit;
    const bool eager =
        kQuietPart * under_way <= load_.link_credit_bytes && kEagerPart * waiting >= full;
    if (count == 0 || (count < full && !partial && !eager)) break;
    send_batch(link, link.outbox.oldest(count));
    link.outbox.drop_oldest(count);
    outbox_rays_ -= count;
  }
  if (link.send_credit < kRayBytes && (is_full() || !link.class_outbox.empty()))
    send_on_class(link);
}

void Node::send_batch(Link& link, std::span<const RayTask> rays, BatchType type) {
  Bytes batch = encode_rays(stamp(link.next_sequence++), rays, type);
  ring_.message_sent();
  ++stats_.ray_batches;
  stats_.ray_bytes += batch.size();
  stats_.rays_out += rays.size();
  if (type == BatchType::kRays) link.send_credit -= rays.size() * kRayBytes;
  outgoing_.push_back({link.peer, Message::of_batch(std::move(batch))});
}

/// Flow blocking: sends what the evaluator holds, one ray a message and in order; a full queue
/// holds up all that is behind.
void Node::send_stalled() {
  const bool was_stalled = !stalled_.empty();
  while (!stalled_.empty()) {
    const RayTask& ray = stalled_.front();
    Link& link = links_[bit_of(owner_of(ray.region))];
    if (link.send_credit < kRayBytes) return;
    send_batch(link, {&ray, 1});
    stalled_.pop_front();
  }
  if (was_stalled && all_evaluators_wait()) flush_on_idle();
}

/// Gives back what was taken from the inbox, when it is at least so many bytes.
void Node::grant_credit(Link& link, std::uint64_t least) {
  if (link.ungranted == 0 || link.ungranted < least) return;
  outgoing_.push_back({link.peer, Message::of_batch(encode_link_credit(stamp(link.next_sequence++),
                                                                       link.ungranted))});
  link.granted += link.ungranted;
  link.ungranted = 0;
}

/// To the frontal, or to the parent in the tree of sums: then the token counts them as it counts
/// rays.
void Node::flush_contributions() {
  if (merge_.is_empty()) return;
  holds_others_light_ = false;
  std::uint64_t& sequence =
      parent_ ? links_[bit_of(*parent_)].next_sequence : contribution_sequence_;
  Bytes batch = encode_contributions(stamp(sequence++), merge_.gathered().credits,
                                     merge_.gathered().contributions);
  merge_.clear();
  if (parent_) {
    ring_.message_sent();
    ++stats_.sum_batches;
    stats_.sum_bytes += batch.size();
  } else {
    ring_.contribution_batch_sent();
    ++stats_.contribution_batches;
    stats_.contribution_bytes += batch.size();
  }
  outgoing_.push_back({parent_, Message::of_batch(std::move(batch))});
}

void Node::flush_on_idle() {
  for (Link& link : links_) {
    send_rays(link, true);
    // Less is kept for the next time: the peer has enough left, and each grant is a message.
    grant_credit(link, load_.link_credit_bytes / kQuietPart);
  }
  flush_contributions();
  offer_help();
  pass_token();
}

bool Node::has_unfinished() const {
  return !rays_.is_empty() || !own_rays_.is_empty() || !class_rays_.is_empty() ||
         !passing_.empty() || !helped_.empty() || !tiles_.empty() || open_tile_ ||
         unassigned_tiles_ != 0 || !stalled_.empty() || rays_in_wait_ != 0 || outbox_rays_ != 0 ||
         !merge_.is_empty();
}

bool Node::is_passive() const {
  return state_ == State::kRendering && working_ == 0 && lent_.empty() && !has_unfinished();
}

/// `ping`: that of the frontal which is being answered.
void Node::pass_token(std::optional<std::uint64_t> ping) {
  if (load_.algorithm != Algorithm::kMacro || state_ != State::kRendering) return;
  const bool had_verdict = ring_.verdict().has_value();
  const auto may_launch = [&] {
    if (ring_.stalled_rounds() > kFreeStalledRounds) return ping.has_value();
    // In 1987 the token went round all the time.
    return is_blocking() || all_are_whole_ || ring_.rounds_launched() < kFreeRounds ||
           (ping && *ping % kPingsToARound == 0);
  };
  while (const auto token = ring_.try_pass(is_passive(), may_launch())) {
    const Rank next = cube_->ring_next(id_.rank);
    if (next == id_.rank) {
      GRAYCUBE_CHECK(ring_.token_arrived(*token), "a ring of one lost its token");
      send_control(
          control::TokenRound{job_, epoch_, token->round, token->hops, token->black, token->count});
      continue;
    }
    Link& link = links_[bit_of(next)];
    const TokenRecord record{token->black, token->count, token->round, token->hops,
                             token->contribution_batches};
    outgoing_.push_back(
        {next, Message::of_batch(encode_token(stamp(link.next_sequence++), record))});
  }
  if (had_verdict || !ring_.verdict()) return;
  const Verdict& v = *ring_.verdict();
  if (v.outcome == Verdict::Outcome::kLost) {
    send_control(control::NodeError{job_, "the token counts " + std::to_string(v.missing) +
                                              " batches sent but never received"});
    return;
  }
  send_control(control::Terminated{job_, epoch_, v.rounds, v.hops, v.contribution_batches});
}

std::vector<Node::Outgoing> Node::take_outgoing() {
  // No evaluator may come by to send on what others sent here.
  if (holds_others_light_ && state_ == State::kRendering && all_evaluators_wait()) flush_on_idle();
  return std::exchange(outgoing_, {});
}

}  // namespace graycube
