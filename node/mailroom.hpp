// The thread that owns a node's sockets, and wires its brain to the frontal, the neighbours, the
// evaluators and the FIFO's process.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "node/evaluator_pool.hpp"
#include "node/fifo_process.hpp"
#include "node/node.hpp"
#include "node/parts/neighbour_door.hpp"
#include "transport/curve_keys.hpp"
#include "transport/doorkeeper.hpp"
#include "transport/secret.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {

/// What all nodes of a process have in common.
struct FarmAccess {
  /// Evaluators of each node.
  std::uint32_t threads = 1;
  /// The frontal's endpoint, and the folder of the nodes' inboxes.
  std::string frontal, folder;
  /// The address at which nodes listen for those of other hosts; empty if there are none.
  std::string address;
  /// What the farm's own processes know.
  Secret secret{};
};

std::string inbox_of(const FarmAccess& farm, Rank rank);

class Mailroom {
 public:
  /// Called by the mailroom's thread: another node is to run in this process, too.
  using TakeIn = std::function<void(const control::Host&)>;

  /// Opens the sockets and says hello. `is_guest`: the process was started for another node. Throws
  /// TransportError.
  Mailroom(const FarmAccess& farm, Rank rank, std::uint32_t incarnation, bool is_guest,
           TakeIn take_in);

  /// Runs until the frontal ends the node.
  void run();

 private:
  void take_mail();
  void serve_fifo();
  void send(Node::Outgoing& o);
  Connection& link_to(Rank neighbour);
  Connection connect(const std::string& endpoint);
  std::unique_ptr<Inbox> make_inbox(const FarmAccess& farm, Rank rank);

  struct Link {
    std::string endpoint;
    Connection connection;
  };

  ZmqContext context_;
  Wakeup wakeup_;
  CurvePair keys_;
  std::optional<Doorkeeper> doorkeeper_;
  std::unique_ptr<Inbox> inbox_;
  Connection frontal_;
  /// Connections to the neighbours that this node connects to.
  std::map<Rank, Link> links_;
  /// All that can bring messages.
  std::vector<Readable*> sockets_{inbox_.get(), &frontal_};
  Rank rank_;
  Node node_;
  EvaluatorPool pool_;
  NeighbourDoor door_;
  FifoProcess fifo_;
  TakeIn take_in_;
  std::vector<Node::Outgoing> outgoing_;
  std::vector<control::Host> guests_;
  std::vector<Bytes> for_fifo_;
  std::optional<FifoOrder> fifo_order_;
};

}  // namespace graycube
