// What a part of the frontal has put into the post, for tests.
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "catch.hpp"
#include "frontal/parts/post.hpp"
#include "proto/batch.hpp"
#include "proto/control.hpp"

namespace graycube::testing {

/// Node 3 is reached by "node 3".
inline PeerId peer_of(std::uint32_t rank) { return "node " + std::to_string(rank); }

/// All nodes can be reached.
inline Post post_of(std::uint32_t nodes) {
  Post post(nodes);
  for (std::uint32_t rank = 0; rank < nodes; ++rank) post.set_node(Rank{rank}, peer_of(rank));
  return post;
}

struct SentPost {
  std::vector<Post::Outgoing> all;

  explicit SentPost(Post& post) : all(post.take()) {}

  /// Control messages of a kind that somebody was sent.
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
  /// The names of all messages, and of batches, in order, with whom they are for.
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

/// The message of a kind that a request is granted with.
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
