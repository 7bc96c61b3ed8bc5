// Neighbours that help each other: who has nothing to do says so, and gets tiles and rays of a neighbour that has
// much, to trace them in a copy of its regions.
#include <algorithm>
#include <utility>

#include "node/node.hpp"
#include "proto/control.hpp"
#include "proto/share_of.hpp"

namespace graycube {
namespace {

/// Own tiles not begun, and rays received, from which on a node shares them. A ray costs about as much to send as to
/// trace, so that it takes many of them.
constexpr std::size_t kTilesToShare = 2;
constexpr std::size_t kRaysToShare = 1024;
/// Before a neighbour has a copy it takes so many tiles, and one more for so many bytes of the slice: to send and subdivide it costs about
/// as much as to trace them.
constexpr std::size_t kTilesToCopy = 8;
constexpr std::size_t kBytesPerTile = std::size_t{16} << 10;
constexpr std::size_t kBytesPerRay = 32;
/// Of a received ray, before it is traced, in tests of a primitive.
constexpr double kRayWork = 50;
/// What a tile takes is known once so many have been traced.
constexpr std::uint64_t kTellingTiles = 4;
/// Given away at a time: at most half of what there is.
constexpr std::size_t kMostTilesAtATime = 16;
constexpr std::size_t kMostRaysAtATime = 512;

}  // namespace

void Node::on_copy(const control::Copy& m, const SharedBytes& slice) {
  if (m.job != job_ || m.epoch != epoch_ || state_ != State::kRendering) return;
  const std::uint32_t bit = bit_of(Rank{m.rank});
  if (bit >= copies_.size() || domain_->grid() == nullptr) return drop("copy", "not a neighbour's");
  lent_.push_back(CopyWork{Rank{m.rank}, share_of(*cube_, Rank{m.rank}), slice, load_.horizon_bytes});
}

void Node::adopt_copy(Copied& copied) {
  if (!copied.domain) return send_control(control::NodeError{job_, copied.error});
  ++stats_.models_borrowed;
  const std::uint32_t bit = bit_of(copied.from);
  copies_[bit] = std::move(copied.domain);
  links_[bit].has_offered = false;
}

/// Rays leave a neighbour's regions, of which this node holds a copy, for the same region. If that is a neighbour's of the owner, they
/// cross the bit that they would have crossed from there: who is beyond is a neighbour of the node that they go to, and sends
/// them on. So the owner, which is busy, has no part in it.
void Node::leave_copy(std::span<const RayTask> rays, Rank owner) {
  const Rank next = owner_of(rays.front().region);
  if (next == id_.rank) return own_rays_.add(rays, kNoLink);
  forward_across(cube_->first_bit(id_.rank, next, bit_of(owner)), rays);
}

/// Tells the neighbours that there is nothing to do here, each once until it has sent something.
void Node::offer_help() {
  const bool is_dry =
      state_ == State::kRendering && tiles_.empty() && unassigned_tiles_ == 0 && !is_full() && all_evaluators_wait();
  if (!load_.makes_copies || !is_dry) return;
  for (std::uint32_t bit = 0; bit < links_.size(); ++bit) {
    Link& link = links_[bit];
    if (std::exchange(link.has_offered, true)) continue;
    const BatchType type = copies_[bit] ? BatchType::kIdleWithCopy : BatchType::kIdle;
    const auto work = static_cast<std::uint64_t>(work_done_);
    outgoing_.push_back({link.peer, Message::of_batch(encode_offer(stamp(link.next_sequence++), type, work))});
  }
}

/// A neighbour without tiles may begin, and be idle, before this node has heard that the picture begins: its offer
/// waits.
void Node::on_offer(Link& link, std::span<const std::byte> batch, Link::Offer offer) {
  if (std::holds_alternative<BatchError>(decode_offer(batch, limits_, link.offered_after))) return drop("offer", "malformed");
  link.offer = offer;
  share_work();
}

/// 0 while it isn't known.
double Node::work_of_a_tile() const {
  return tiles_traced_ < kTellingTiles ? 0 : work_done_ / static_cast<double>(tiles_traced_);
}

/// What brings both to the same if a neighbour that is idle does it: half of what this node will have done, as far as can be told, beyond what
/// the neighbour has. Who is idle first need not have less to do, but may have been let run first.
double Node::work_to_spare(const Link& link) const {
  const double to_do = work_of_a_tile() * static_cast<double>(tiles_.size() + unassigned_tiles_) +
                       kRayWork * static_cast<double>(rays_.size());
  return 0.5 * (work_done_ + to_do - static_cast<double>(link.offered_after));
}

/// Gives neighbours that have nothing to do something of what waits here.
void Node::share_work() {
  if (!load_.makes_copies) return;
  for (Link& link : links_) {
    if (link.offer == Link::Offer::kIdleWithCopy && share_with(link)) link.offer = Link::Offer::kNone;
    if (link.offer != Link::Offer::kIdle || link.has_asked) continue;
    const double tile = work_of_a_tile(), spare = work_to_spare(link);
    const std::size_t least_tiles = kTilesToCopy + slice_bytes_ / kBytesPerTile;
    const std::size_t least_rays = kRaysToShare + slice_bytes_ / kBytesPerRay;
    const bool pays = (tile > 0 && tiles_.size() >= 2 * least_tiles && spare >= tile * static_cast<double>(least_tiles)) ||
                      (rays_.size() >= least_rays && spare >= 0.5 * kRayWork * static_cast<double>(least_rays));
    if (!pays) continue;
    link.has_asked = true;
    send_control(control::Share{job_, epoch_, link.peer.value});
  }
}

/// Tiles rather than rays: they are a few bytes. The last ones: this node comes from the other end.
bool Node::share_with(Link& link) {
  const std::size_t room = static_cast<std::size_t>(link.send_credit / kRayBytes);
  const double tile = work_of_a_tile(), spare = work_to_spare(link);
  if (tiles_.size() >= kTilesToShare && is_own_tile(tiles_.back()) && tile > 0 && spare >= tile) {
    std::vector<std::uint32_t> tiles;
    const std::size_t most = std::min({tiles_.size() / 2, kMostTilesAtATime, static_cast<std::size_t>(spare / tile)});
    while (tiles.size() < most && is_own_tile(tiles_.back())) {
      tiles.push_back(tiles_.back());
      tiles_.pop_back();
    }
    ring_.message_sent();
    outgoing_.push_back({link.peer, Message::of_batch(encode_assignment(stamp(link.next_sequence++), tiles))});
    return true;
  }
  if (rays_.size() < kRaysToShare || spare < kRayWork) return false;
  const std::size_t most = std::min({rays_.size() / 2, kMostRaysAtATime, room, static_cast<std::size_t>(spare / kRayWork)});
  if (most == 0) return false;
  const std::vector<RayTask> rays = rays_.take(most, [this](std::uint32_t bit, std::size_t count) { take_from(bit, count); });
  send_batch(link, rays);
  return true;
}

/// A neighbour's tiles, to be traced here.
void Node::on_tiles(Link& link, std::span<const std::byte> batch) {
  std::vector<std::uint32_t> tiles;
  const auto result = decode_assignment(batch, limits_, tiles);
  const auto* error = std::get_if<BatchError>(&result);
  const auto is_theirs = [&](std::uint32_t tile) { return owner_of(plan_->owner_of_tile(tile)) == link.peer; };
  if (error != nullptr || !load_.makes_copies || !copies_[bit_of(link.peer)] ||
      !std::all_of(tiles.begin(), tiles.end(), is_theirs)) {
    drop("tiles", error != nullptr ? to_string(*error) : "of regions that are not held here");
    return send_control(control::NodeError{
        job_, "node " + std::to_string(link.peer.value) + " sent tiles that can't be traced here"});
  }
  ring_.message_received();
  link.has_offered = false;
  stats_.tiles_taken_over += tiles.size();
  tiles_.insert(tiles_.end(), tiles.begin(), tiles.end());
}

}  // namespace graycube
