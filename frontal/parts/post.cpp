#include "frontal/parts/post.hpp"

#include "overloaded.hpp"
#include "proto/control.hpp"

namespace graycube {

void Post::to_peer(const PeerId& peer, const ControlMessage& message, SharedBytes payload) {
  outgoing_.push_back({peer, Message::of_text(encode(message), std::move(payload))});
}

void Post::answer(const PeerId& peer, Answer answer) {
  std::visit(Overloaded{
                 [&](Reply& r) { to_peer(peer, r.message, std::move(r.payload)); },
                 [&](Refusal& r) {
                   to_peer(peer, control::Failed{
                                     r.job, r.code, {{std::move(r.where), std::move(r.why)}}, {}});
                 },
             },
             answer);
}

void Post::to_node(Rank rank, const ControlMessage& message, SharedBytes payload) {
  to_peer(nodes_[rank.value], message, std::move(payload));
}

void Post::to_node(Rank rank, Bytes batch) {
  outgoing_.push_back({nodes_[rank.value], Message::of_batch(std::move(batch))});
}

void Post::to_nodes(const ControlMessage& message) {
  const Message encoded = Message::of_text(encode(message));
  for (const PeerId& peer : nodes_) {
    if (!peer.empty()) outgoing_.push_back({peer, encoded});
  }
}

void Post::to_these_nodes(const std::vector<Rank>& ranks, const ControlMessage& message) {
  const Message encoded = Message::of_text(encode(message));
  for (const Rank rank : ranks) {
    if (const PeerId& peer = nodes_[rank.value]; !peer.empty())
      outgoing_.push_back({peer, encoded});
  }
}

void Post::to_peers(const std::vector<PeerId>& peers, const ControlMessage& message) {
  const Message encoded = Message::of_text(encode(message));
  for (const PeerId& peer : peers) outgoing_.push_back({peer, encoded});
}

void Post::to_each_node(const ControlMessage& message,
                        const std::function<std::optional<SharedBytes>(Rank)>& payload_of) {
  const std::string text = encode(message);
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) {
    if (auto payload = payload_of(Rank{rank}))
      outgoing_.push_back({nodes_[rank], Message::of_text(text, *std::move(payload))});
  }
}

}  // namespace graycube
