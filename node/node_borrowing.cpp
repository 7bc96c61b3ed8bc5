// Shadows local: other nodes' models, and the shadow rays that wait for them.
#include <algorithm>
#include <utility>

#include "node/node.hpp"
#include "proto/control.hpp"

namespace graycube {

/// A shadow ray goes on when the model that it lacks is here. False where there is no memory for that:
/// then it goes on with the neighbour whose region it has entered.
bool Node::waits_for_model(Rank owner, const RayTask& ray) {
  Loan& b = borrowed_[owner.value];
  if (b.state == Loan::State::kUnasked) {
    const std::uint64_t room = load_.borrow_bytes - std::min(load_.borrow_bytes, borrowed_bytes_);
    b.state = room > 0 ? Loan::State::kAsked : Loan::State::kRefused;
    // A model takes about this many times its slice once it is subdivided.
    constexpr std::uint64_t kMemoryPerSliceByte = 4;
    if (room > 0) {
      send_control(control::Borrow{job_, epoch_, owner.value, room / kMemoryPerSliceByte});
    }
  }
  switch (b.state) {
    case Loan::State::kHeld: own_rays_.add({&ray, 1}, kNoLink); return true;
    case Loan::State::kRefused: return false;
    default: break;
  }
  b.waiting.push_back(ray);
  ++rays_in_wait_;
  return true;
}

void Node::on_lend(const control::Lend& m, const SharedBytes& slice) {
  if (m.job != job_ || m.epoch != epoch_ || state_ != State::kRendering) return;
  if (m.rank >= borrowed_.size() || borrowed_[m.rank].state != Loan::State::kAsked) {
    return drop("lend", "not asked for");
  }
  if (!slice.empty()) return lent_.push_back(BorrowWork{Rank{m.rank}, slice});
  Loan& b = borrowed_[m.rank];
  b.state = Loan::State::kRefused;
  rays_in_wait_ -= b.waiting.size();
  for (const RayTask& ray : std::exchange(b.waiting, {})) forward_across(bit_of(owner_of(ray.region)), {&ray, 1});
  // No evaluator may come by to send what is left.
  for (Link& link : links_) send_rays(link, true);
  pass_token();
}

void Node::adopt_borrowed(Borrowed& borrowed) {
  if (!borrowed.model) return send_control(control::NodeError{job_, borrowed.error});
  Loan& b = borrowed_[borrowed.from.value];
  b.state = Loan::State::kHeld;
  borrowed_bytes_ += borrowed.model->memory_bytes();
  ++stats_.models_borrowed;
  domain_ = domain_->with_borrowed(cube_->column_of(borrowed.from), cube_->row_of(borrowed.from),
                                   std::move(borrowed.model));
  rays_in_wait_ -= b.waiting.size();
  own_rays_.add(std::exchange(b.waiting, {}), kNoLink);
}

}  // namespace graycube
