// Which connections to a node's inbox are its neighbours': those that greeted with the farm's
// secret. What others send is dropped before it is looked at.
#pragma once

#include <algorithm>
#include <cstdio>
#include <map>
#include <span>
#include <string>

#include "proto/batch.hpp"
#include "topology/rank.hpp"
#include "transport/message.hpp"
#include "transport/secret.hpp"

namespace graycube {

class NeighbourDoor {
 public:
  NeighbourDoor(Rank own, const Secret& secret) : own_(own), secret_(secret) {}

  /// Whether a message from the connection `peer` counts. A greeting with the secret, which is its
  /// payload, makes the connection its sender's: a neighbour's new process greets on a new one.
  [[nodiscard]] bool lets_in(const std::string& peer, const MessageView& message) {
    const auto header = peek_header(message.frame);
    const auto* h = std::get_if<BatchHeader>(&header);
    if (h == nullptr || h->type != BatchType::kGreeting) return is_known(peer);
    if (!is_same_secret(message.payload, secret_)) {
      tell_of_stranger();
      return false;
    }
    peers_[Rank{h->stamp.sender}] = peer;
    return true;
  }

  /// The connection to a neighbour that has greeted; null before.
  const std::string* connection_to(Rank neighbour) const {
    const auto found = peers_.find(neighbour);
    return found == peers_.end() ? nullptr : &found->second;
  }

  /// Adds the secret to a message if it is a greeting.
  void sign(Message& message) const {
    if (message.frame.size() != kBatchHeaderBytes) return;
    const auto header = peek_header(message.frame);
    const auto* h = std::get_if<BatchHeader>(&header);
    if (h != nullptr && h->type == BatchType::kGreeting)
      message.payload = Bytes(secret_.begin(), secret_.end());
  }

 private:
  bool is_known(const std::string& peer) const {
    return std::ranges::any_of(peers_, [&](const auto& p) { return p.second == peer; });
  }
  void tell_of_stranger() {
    if (++strangers_ > kMaxStrangersTold) return;
    std::fprintf(stderr, "graycube-node: node %u: dropped: a greeting without the farm's secret\n",
                 own_.value);
  }

  Rank own_;
  Secret secret_;
  std::map<Rank, std::string> peers_;
  unsigned strangers_ = 0;
};

}  // namespace graycube
