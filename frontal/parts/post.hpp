// The messages that the frontal sends, in order, and the connection to each node.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "proto/messages.hpp"
#include "topology/rank.hpp"
#include "transport/message.hpp"

namespace graycube {

/// The name that the transport gives a connection.
using PeerId = std::string;

/// The answer to a request that is granted.
struct Reply {
  ControlMessage message;
  SharedBytes payload{};
};

/// Why a request is not granted.
struct Refusal {
  /// The job that the request names; 0 where it names none.
  std::uint32_t job = 0;
  FailureCode code = FailureCode::kBadRequest;
  /// The field of the message, or the option, that is at fault; empty if it is neither.
  std::string where;
  std::string why;
};

using Answer = std::variant<Reply, Refusal>;

class Post {
 public:
  struct Outgoing {
    PeerId to;
    Message message;
  };

  explicit Post(std::uint32_t nodes) : nodes_(nodes) {}
  /// Forgets all connections to nodes; from here on there are so many nodes.
  void begin_anew(std::uint32_t nodes) { nodes_.assign(nodes, {}); }
  /// Sets the connection to the node of that rank; an empty `peer` means that there is none.
  void set_node(Rank rank, PeerId peer) { nodes_[rank.value] = std::move(peer); }

  void to_peer(const PeerId& peer, const ControlMessage& message, SharedBytes payload = {});
  void answer(const PeerId& peer, Answer answer);
  void to_node(Rank rank, const ControlMessage& message, SharedBytes payload = {});
  void to_node(Rank rank, Bytes batch);
  /// Sends a message to all nodes that have a connection.
  void to_nodes(const ControlMessage& message);
  void to_these_nodes(const std::vector<Rank>& ranks, const ControlMessage& message);
  void to_peers(const std::vector<PeerId>& peers, const ControlMessage& message);
  /// The same with a payload for each node; nothing is sent to a node that has none.
  void to_each_node(const ControlMessage& message,
                    const std::function<std::optional<SharedBytes>(Rank)>& payload_of);

  std::vector<Outgoing> take() { return std::exchange(outgoing_, {}); }

 private:
  std::vector<PeerId> nodes_;  // by rank
  std::vector<Outgoing> outgoing_;
};

}  // namespace graycube
