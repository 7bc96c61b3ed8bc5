#include "node/parts/light_out.hpp"

#include <string>

#include "check.hpp"

namespace graycube {

LightOut::LightOut(const Seat& seat, SumsMode sums) : is_child_(seat.links()) {
  if (sums != SumsMode::kTree) return;
  if (const auto parent = seat.cube.tree_parent(seat.rank)) parent_bit_ = seat.bit_of(*parent);
  for (const Rank child : seat.cube.tree_children(seat.rank)) is_child_[seat.bit_of(child)] = true;
  has_children_ = !seat.cube.tree_children(seat.rank).empty();
  merged_.expect_others(has_children_);
}

void LightOut::reset() {
  merged_.clear();
  holds_others_light_ = false;
}

void LightOut::add(std::span<const PixelReturn> returns, std::optional<std::uint32_t> tile,
                   const TilePlan& plan, Mail& mail) {
  while (!returns.empty()) {
    // When children's light for the same pixels will come, each pixel must have one place only.
    const bool comes_once = tile && !has_children_;
    returns = returns.subspan(comes_once ? merged_.add_tile(returns, *tile, plan)
                                         : merged_.add(returns, plan));
    if (merged_.is_full()) send(mail);
  }
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
    send(mail);
    GRAYCUBE_CHECK(merged_.add_gathered(credits, contributions), "no room in an empty buffer");
  }
  holds_others_light_ = true;
  if (merged_.is_full()) send(mail);
  return true;
}

void LightOut::send(Mail& mail) {
  if (is_empty()) return;
  holds_others_light_ = false;
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
  stats.contribution_batches = to_frontal_.batches;
  stats.contribution_bytes = to_frontal_.bytes;
  stats.sum_batches = to_parent_.batches;
  stats.sum_bytes = to_parent_.bytes;
}

}  // namespace graycube
