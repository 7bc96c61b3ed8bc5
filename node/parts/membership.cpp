#include "node/parts/membership.hpp"

#include <algorithm>
#include <utility>

namespace graycube {

control::Hello Membership::hello() const {
  control::Hello m;
  m.rank = id_.rank.value;
  m.pid = id_.pid;
  m.incarnation = id_.incarnation;
  m.endpoint = id_.endpoint;
  m.threads = id_.threads;
  m.version = id_.version;
  m.remote_endpoint = id_.remote_endpoint;
  return m;
}

void Membership::report(control::NodeStats& stats) const {
  stats.rank = id_.rank.value;
  stats.gray = seat_->cube.label_of(id_.rank).value;
  stats.pid = id_.pid;
}

bool Membership::join(const control::Welcome& welcome) {
  const auto cube = Hypercube::of_size(welcome.nodes);
  if (!cube || !cube->has(id_.rank) || welcome.endpoints.size() != welcome.nodes) return false;
  seat_ = Seat{*cube, id_.rank};
  endpoints_ = welcome.endpoints;
  greeted_.resize(seat_->links());
  return true;
}

std::vector<Rank> Membership::peers() const {
  std::vector<Rank> peers;
  for (std::uint32_t bit = 0; bit < seat_->links(); ++bit) peers.push_back(seat_->peer(bit));
  return peers;
}

/// Neighbours that know this node are greeted again: each welcome means that some node is new.
bool Membership::is_to_greet(std::uint32_t bit) const {
  const Rank peer = seat_->peer(bit);
  return connects_to(id_.rank, peer) && !endpoints_[peer.value].empty();
}

void Membership::keep_early(std::span<const std::byte> greeting) {
  if (early_greetings_.size() == kMaxDimension) return;
  early_greetings_.emplace_back(greeting.begin(), greeting.end());
}

std::vector<Bytes> Membership::take_early() { return std::exchange(early_greetings_, {}); }

bool Membership::have_all_greeted() const {
  return std::ranges::find(greeted_, false) == greeted_.end();
}

void Membership::begin(std::uint32_t job, std::uint32_t epoch) {
  incarnations_.clear();
  job_ = job;
  epoch_ = epoch;
}

bool Membership::is_of_now(const BatchStamp& stamp) const {
  if (!is_now(stamp.job, stamp.epoch)) return false;
  return stamp.sender >= incarnations_.size() || incarnations_[stamp.sender] == stamp.incarnation;
}

}  // namespace graycube
