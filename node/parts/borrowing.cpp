#include "node/parts/borrowing.hpp"

#include <algorithm>
#include <utility>

namespace graycube {

Borrowing::Place Borrowing::place_of(Rank owner, const RayTask& ray, Mail& mail) {
  Loan& loan = loans_[owner.value];
  if (loan.state == Loan::State::kUnasked) ask(owner, mail);
  if (loan.state == Loan::State::kHeld) return Place::kHere;
  if (loan.state == Loan::State::kRefused) return Place::kThere;
  loan.waiting.push_back(ray);
  return Place::kWaits;
}

void Borrowing::ask(Rank owner, Mail& mail) {
  loans_[owner.value].state = room_ > 0 ? Loan::State::kAsked : Loan::State::kRefused;
  // A model takes about this many times its slice once it is subdivided.
  constexpr std::uint64_t kMemoryPerSliceByte = 4;
  if (room_ > 0) {
    mail.to_frontal(
        control::Borrow{mail.job(), mail.epoch(), owner.value, room_ / kMemoryPerSliceByte});
  }
}

bool Borrowing::is_asked(Rank owner) const {
  return owner.value < loans_.size() && loans_[owner.value].state == Loan::State::kAsked;
}

std::vector<RayTask> Borrowing::came(Rank owner, std::uint64_t memory_bytes) {
  ++models_;
  room_ -= std::min(room_, memory_bytes);
  loans_[owner.value].state = Loan::State::kHeld;
  return std::exchange(loans_[owner.value].waiting, {});
}

std::vector<RayTask> Borrowing::was_refused(Rank owner) {
  loans_[owner.value].state = Loan::State::kRefused;
  return std::exchange(loans_[owner.value].waiting, {});
}

void Borrowing::reset() {
  for (Loan& loan : loans_) {
    loan.waiting.clear();
    if (loan.state == Loan::State::kAsked) loan.state = Loan::State::kUnasked;
  }
}

}  // namespace graycube
