// Shadows local: other nodes' models, and the shadow rays that wait for them.
#include <algorithm>
#include <utility>

#include "node/node.hpp"
#include "proto/control.hpp"

namespace graycube {

/// A shadow ray goes on when the model that it lacks is here. False where there is no memory for
/// that: then it goes on with the neighbour whose region it has entered.
bool Node::waits_for_model(Rank owner, const RayTask& ray) {
  Borrowed& b = borrowed_[owner.value];
  if (b.state == Borrowed::State::kUnasked) {
    const std::uint64_t room = load_.borrow_bytes - std::min(load_.borrow_bytes, borrowed_bytes_);
    b.state = room > 0 ? Borrowed::State::kAsked : Borrowed::State::kRefused;
    // A model takes about this many times its slice once it is subdivided.
    constexpr std::uint64_t kMemoryPerSliceByte = 4;
    if (room > 0) {
      send_control(control::Borrow{job_, epoch_, owner.value, room / kMemoryPerSliceByte});
    }
  }
  switch (b.state) {
    case Borrowed::State::kHeld: own_rays_.add({&ray, 1}, kNoLink); return true;
    case Borrowed::State::kRefused: return false;
    default: break;
  }
  b.waiting.push_back(ray);
  ++rays_in_wait_;
  return true;
}

void Node::on_lend(const control::Lend& m, const SharedBytes& slice) {
  if (m.job != job_ || m.epoch != epoch_ || state_ != State::kRendering) return;
  if (m.rank >= borrowed_.size() || borrowed_[m.rank].state != Borrowed::State::kAsked) {
    return drop("lend", "not asked for");
  }
  if (!slice.empty()) return lent_.push_back(BorrowWork{Rank{m.rank}, slice});
  Borrowed& b = borrowed_[m.rank];
  b.state = Borrowed::State::kRefused;
  rays_in_wait_ -= b.waiting.size();
  for (const RayTask& ray : std::exchange(b.waiting, {}))
    forward_across(bit_of(owner_of(ray.region)), {&ray, 1});
  // No evaluator may come by to send what is left.
  for (Link& link : links_) send_rays(link, true);
  pass_token();
}

void Node::adopt_borrowed(WorkResult& result) {
  if (!result.borrowed) {
    send_control(control::NodeError{job_, result.error});
    return;
  }
  const Rank from = *result.borrowed_from;
  Borrowed& b = borrowed_[from.value];
  b.state = Borrowed::State::kHeld;
  borrowed_bytes_ += result.borrowed->memory_bytes();
  ++stats_.models_borrowed;
  domain_ = domain_->with_borrowed(cube_->column_of(from), cube_->row_of(from),
                                   std::move(result.borrowed));
  rays_in_wait_ -= b.waiting.size();
  own_rays_.add(std::exchange(b.waiting, {}), kNoLink);
}

}  // namespace graycube
