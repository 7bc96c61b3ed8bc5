// Where a frontal is reached: by its nodes at a local socket in the farm's own folder, by clients
// at the endpoint that the user chose; by nodes elsewhere at a TCP port. Clients have limits, and
// none can pass for a node.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "frontal/parts/post.hpp"
#include "proto/messages.hpp"
#include "transport/doorkeeper.hpp"
#include "transport/farm_key.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {

/// What one client may take: answers that it doesn't fetch, and requests that wait for the frontal.
/// An answer with rows of a picture has about a megabyte (kPictureChunkBytes).
inline constexpr int kMaxUnsentAnswers = 64, kMaxUnreadRequests = 8;
/// A scene, the longest that clients send.
inline constexpr std::size_t kMaxClientFrameBytes = kMaxSubmitBytes;
/// A client that doesn't show the key of the farm so many milliseconds after it has connected is
/// disconnected.
inline constexpr int kClientHandshake_ms = 5000;

/// At least so many connections of clients are open when further ones are closed at once.
inline constexpr int kMaxClientConnections = 1024;

struct DoorPlaces {
  /// Of the farm's own sockets.
  std::filesystem::path folder;
  /// The clients' endpoint; empty for a socket in `folder`.
  std::string listen;
  /// Where the key of a farm at a TCP port is kept, and stays; empty for the usual place, where it
  /// lies as long as the farm runs.
  std::string key_file;
  /// The most files and sockets that the process has open beside clients' connections.
  int others = 0;
  /// An address of this machine ("10.0.0.3", "*") at which nodes of others reach it; empty if all
  /// run here.
  std::string address_for_nodes;
};

class Doors {
 public:
  /// Throws TransportError and KeyError.
  explicit Doors(const DoorPlaces& places);
  ~Doors();
  Doors(const Doors&) = delete;
  Doors& operator=(const Doors&) = delete;

  const std::string& for_nodes() const { return nodes_->endpoint(); }
  /// Where nodes of other machines connect, with the nodes' key; empty if they can't.
  const std::string& for_far_nodes() const { return nodes_->tcp_endpoint(); }
  /// Its port; 0 if there is none.
  std::uint16_t port_for_far_nodes() const;
  const std::string& for_clients() const { return clients_->endpoint(); }
  /// The file of the key that clients must show; empty if they need none.
  const std::string& key_file() const { return key_file_; }
  /// Nothing if nobody listens at a TCP port.
  const std::optional<FarmKeys>& keys() const { return keys_; }

  struct Received {
    PeerId peer;
    /// Valid until the next call of receive().
    MessageView message;
    /// It came in at the clients' door, but with the nodes' key: a host that joins.
    bool is_host = false;
  };
  std::optional<Received> receive();
  /// Sends to a peer that has sent something before; drops the message if it has gone, or if it is
  /// a client that doesn't read its answers.
  void send(const PeerId& peer, Message message);
  /// Who was turned away for want of a key, since this was last asked.
  std::vector<TurnedAway> take_refusals();
  /// Connections beyond kMaxClientConnections that were closed, since this was last asked.
  static std::uint64_t take_crowded_out();
  std::array<Readable*, 2> sockets() { return {&*nodes_, &*clients_}; }

 private:
  FoundKey find_key(const std::filesystem::path& folder);
  void open(const DoorPlaces& places);
  void remove_key() const;

  ZmqContext context_;
  std::string clients_at_, key_file_;
  bool is_key_files_owner_;
  std::optional<FarmKeys> keys_;
  std::optional<Doorkeeper> doorkeeper_;
  std::optional<Inbox> nodes_, clients_;
};

}  // namespace graycube
