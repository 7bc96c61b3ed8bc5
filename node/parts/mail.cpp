#include "node/parts/mail.hpp"

#include <cstdio>

namespace graycube {

void Mail::set_peers(const std::vector<Rank>& peers) {
  links_.resize(peers.size());
  for (std::size_t bit = 0; bit < peers.size(); ++bit) links_[bit].peer = peers[bit];
}

void Mail::begin(const BatchStamp& first) {
  first_ = first;
  for (Link& link : links_) link = {link.peer, 0, 0};
  sent_to_frontal_ = 0;
  came_from_frontal_ = 0;
  counted_ = {};
  for_fifo_.clear();
}

BatchStamp Mail::stamped(std::uint64_t sequence) const {
  BatchStamp stamp = first_;
  stamp.sequence = sequence;
  return stamp;
}

std::size_t Mail::post(std::optional<Rank> to, Bytes batch) {
  const std::size_t bytes = batch.size();
  outgoing_.push_back({to, Message::of_batch(std::move(batch))});
  return bytes;
}

void Mail::to_frontal(const ControlMessage& message) {
  outgoing_.push_back({std::nullopt, Message::of_text(encode(message))});
}

void Mail::fail(std::string why) {
  to_frontal(control::NodeError{first_.job, first_.epoch, std::move(why)});
}

void Mail::fail_for_good(std::string why) {
  to_frontal(control::NodeError{first_.job, first_.epoch, std::move(why), true});
}

void Mail::signal(std::uint32_t bit, BatchType type) {
  post(links_[bit].peer, encode_signal(first_, type));
}

void Mail::drop(const char* what, std::string_view why) {
  ++drops_;
  std::fprintf(stderr, "graycube-node: node %u: dropped: %s: %.*s\n", first_.sender, what,
               static_cast<int>(why.size()), why.data());
}

}  // namespace graycube
