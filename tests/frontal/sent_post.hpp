// Reads the messages that a part of the frontal has posted, for tests.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "catch.hpp"
#include "frontal/parts/post.hpp"
#include "proto/batch.hpp"
#include "proto/control.hpp"

namespace graycube::testing {

/// The name of a node's connection: "node 3" for rank 3.
inline PeerId peer_of(std::uint32_t rank) { return "node " + std::to_string(rank); }

/// A post in which all nodes can be reached.
inline Post post_of(std::uint32_t nodes) {
  Post post(nodes);
  for (std::uint32_t rank = 0; rank < nodes; ++rank) post.set_node(Rank{rank}, peer_of(rank));
  return post;
}

struct SentPost {
  std::vector<Post::Outgoing> all;

  explicit SentPost(Post& post) : all(post.take()) {}

  /// The control messages of a type that were sent to anybody.
  template <typename T>
  std::vector<T> told(const PeerId& peer) const {
    std::vector<T> told;
    for (const Post::Outgoing& o : all) {
      if (o.to != peer || looks_like_batch(o.message.frame)) continue;
      const auto decoded = decode(o.message.text());
      if (const auto* m = std::get_if<T>(&std::get<ControlMessage>(decoded))) told.push_back(*m);
    }
    return told;
  }
  /// The names of all messages, and of batches, in order, with the peers that they are for.
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const Post::Outgoing& o : all) {
      const auto& frame = o.message.frame;
      names.push_back(o.to + ": " +
                      (looks_like_batch(frame)
                           ? std::string(to_string(std::get<BatchHeader>(peek_header(frame)).type))
                           : name_of(o.message)));
    }
    return names;
  }

 private:
  static std::string name_of(const Message& message) {
    const auto decoded = decode(message.text());
    return std::string(type_of(std::get<ControlMessage>(decoded)));
  }
};

/// The message with which a request is granted; it must be of that type.
template <typename T>
T granted(const Answer& answer) {
  const auto* reply = std::get_if<Reply>(&answer);
  REQUIRE(reply != nullptr);
  const auto* message = std::get_if<T>(&reply->message);
  REQUIRE(message != nullptr);
  return *message;
}

inline FailureCode refused(const Answer& answer) {
  const auto* refusal = std::get_if<Refusal>(&answer);
  REQUIRE(refusal != nullptr);
  return refusal->code;
}

}  // namespace graycube::testing
