#include "node/parts/light_out.hpp"

#include <string>
#include <utility>

#include "check.hpp"
#include "topology/spanning_tree.hpp"

namespace graycube {

LightOut::LightOut(const Seat& seat, SumsMode sums, std::unique_ptr<LightBack> back)
    : back_(std::move(back)), is_child_(seat.links()) {
  if (sums == SumsMode::kDirect) return;
  const SpanningTree tree(seat.cube, sums == SumsMode::kRing ? SpanningTree::Shape::kChain
                                                             : SpanningTree::Shape::kBinomial);
  if (const auto parent = tree.parent(seat.rank)) parent_bit_ = seat.bit_of(*parent);
  const std::vector<Rank> children = tree.children(seat.rank);
  for (const Rank child : children) is_child_[seat.bit_of(child)] = true;
  has_children_ = !children.empty();
  merged_.expect_others(has_children_);
}

void LightOut::reset() {
  if (back_) back_->reset();
  merged_.clear();
  holds_others_light_ = false;
}

void LightOut::add(std::span<const PixelReturn> returns, std::optional<std::uint32_t> tile,
                   const TilePlan& plan, Mail& mail) {
  if (!back_) return gather(returns, tile, plan, mail);
  gather(back_->take(returns, mail), tile, plan, mail);
}

void LightOut::gather(std::span<const PixelReturn> returns, std::optional<std::uint32_t> tile,
                      const TilePlan& plan, Mail& mail) {
  while (!returns.empty()) {
    // When children's light for the same pixels will come, each pixel must have one place only.
    const bool comes_once = tile && !has_children_;
    returns = returns.subspan(comes_once ? merged_.add_tile(returns, *tile, plan)
                                         : merged_.add(returns, plan));
    if (merged_.is_full()) send_merged(mail);
  }
}

bool LightOut::on_answers(std::uint32_t bit, std::span<const std::byte> batch,
                          const BatchLimits& limits, const TilePlan& plan, Mail& mail) {
  if (!back_) {
    mail.drop("answers", "light does not go that way");
    mail.fail("answers came from node " + std::to_string(mail.peer(bit).value) +
              ", which was asked nothing");
    return false;
  }
  const auto complete = back_->on_answers(bit, batch, limits, mail);
  if (!complete) return false;
  gather(*complete, std::nullopt, plan, mail);
  holds_others_light_ = true;
  return true;
}

bool LightOut::on_sums(std::uint32_t bit, std::span<const std::byte> batch,
                       const BatchLimits& limits, Mail& mail) {
  BatchLimits with_aovs = limits;
  with_aovs.pixel_count *= 1 + kAovPlanes;
  std::vector<TileCredit> credits;
  std::vector<Contribution> contributions;
  const auto result = decode_contributions(batch, with_aovs, credits, contributions);
  const auto* error = std::get_if<BatchError>(&result);
  if (error != nullptr || !is_child_[bit] || credits.size() > MergeBuffer::kMostPixels ||
      contributions.size() > MergeBuffer::kMostPixels) {
    mail.drop("contributions", error != nullptr ? to_string(*error) : "not a child's, or too many");
    mail.fail("a broken batch of contributions came from node " +
              std::to_string(mail.peer(bit).value));
    return false;
  }
  if (!merged_.add_gathered(credits, contributions)) {
    send_merged(mail);
    GRAYCUBE_CHECK(merged_.add_gathered(credits, contributions), "no room in an empty buffer");
  }
  holds_others_light_ = true;
  if (merged_.is_full()) send_merged(mail);
  return true;
}

void LightOut::send(Mail& mail) {
  holds_others_light_ = false;
  if (back_) back_->send(mail);
  send_merged(mail);
}

void LightOut::send_merged(Mail& mail) {
  if (merged_.is_empty()) return;
  holds_others_light_ = back_ && !back_->is_empty();
  const auto encoded = [this](const BatchStamp& stamp) {
    return encode_contributions(stamp, merged_.gathered().credits,
                                merged_.gathered().contributions);
  };
  Sent& sent = parent_bit_ ? to_parent_ : to_frontal_;
  sent.bytes +=
      parent_bit_ ? mail.work_to_neighbour(*parent_bit_, encoded) : mail.light_to_frontal(encoded);
  ++sent.batches;
  merged_.clear();
}

void LightOut::report(control::NodeStats& stats) const {
  if (back_) back_->report(stats);
  stats.contribution_batches = to_frontal_.batches;
  stats.contribution_bytes = to_frontal_.bytes;
  stats.sum_batches = to_parent_.batches;
  stats.sum_bytes = to_parent_.bytes;
}

}  // namespace graycube
