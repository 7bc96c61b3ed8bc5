// Where a frontal is reached: by its nodes at a local socket in the farm's own folder, by clients
// at the endpoint that the user chose. Clients have limits, and none can pass for a node.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "frontal/parts/post.hpp"
#include "proto/messages.hpp"
#include "transport/doorkeeper.hpp"
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

class Doors {
 public:
  /// `listen`: the clients' endpoint, empty for a socket in `folder`. `key_file`: where the key of
  /// a farm at a TCP port is kept; empty for the usual place. `others`: the most files and sockets
  /// that the process has open beside clients' connections. Throws TransportError and KeyError.
  Doors(const std::filesystem::path& folder, const std::string& listen, std::string key_file,
        int others);
  /// Removes the key file, and the run folder if nothing else is in it.
  ~Doors();
  Doors(const Doors&) = delete;
  Doors& operator=(const Doors&) = delete;

  const std::string& for_nodes() const { return nodes_.endpoint(); }
  const std::string& for_clients() const { return clients_->endpoint(); }
  /// The file of the key that clients must show; empty if they need none.
  const std::string& key_file() const { return key_file_; }

  struct Received {
    PeerId peer;
    /// Valid until the next call of receive().
    MessageView message;
  };
  std::optional<Received> receive();
  /// Sends to a peer that has sent something before; drops the message if it has gone, or if it is
  /// a client that doesn't read its answers.
  void send(const PeerId& peer, Message message);
  /// Clients that were turned away for want of a key, since this was last asked.
  std::uint64_t take_refused() { return doorkeeper_ ? doorkeeper_->take_refused() : 0; }
  /// Connections beyond kMaxClientConnections that were closed, since this was last asked.
  static std::uint64_t take_crowded_out();
  std::array<Readable*, 2> sockets() { return {&nodes_, &*clients_}; }

 private:
  ZmqContext context_;
  Inbox nodes_;
  std::string key_file_;
  std::optional<Doorkeeper> doorkeeper_;
  std::optional<Inbox> clients_;
};

}  // namespace graycube
