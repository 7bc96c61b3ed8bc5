// Sockets of ZeroMQ; none but the files beside this one know it. Between a farm's own processes
// high-water marks are 0, that is, none: flow is controlled by credits of our own (a ROUTER
// silently drops messages past its mark). Peers from outside have limits. Whatever goes over TCP is
// encrypted, and both ends show keys (CURVE).
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "transport/curve_keys.hpp"
#include "transport/handshake_trouble.hpp"
#include "transport/message.hpp"
#include "transport/peer_key.hpp"

namespace graycube {

/// A socket could not be made, bound or connected; what() says which endpoint and why.
struct TransportError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The most bytes of a frame that is accepted from a peer.
inline constexpr std::size_t kMaxMessageBytes = std::size_t{1} << 31;

/// What a peer of an inbox may take of this process's memory.
struct PeerLimits {
  /// The most bytes of a frame. A peer that announces more is disconnected before it sends them.
  std::size_t frame_bytes = kMaxMessageBytes;
  /// Messages for the peer that wait to be sent; further ones are dropped. 0: any number.
  int unsent = 0;
  /// Messages of the peer that wait to be received; it can't send more meanwhile. 0: any number.
  int unread = 0;
  /// A peer that hasn't shown a key after so many milliseconds, where one is needed, or hasn't even
  /// said that it knows ZeroMQ, is disconnected.
  int handshake_ms = 30'000;
};

/// Sockets must not outlive it.
class ZmqContext {
 public:
  ZmqContext();
  ~ZmqContext();
  ZmqContext(const ZmqContext&) = delete;
  ZmqContext& operator=(const ZmqContext&) = delete;
  struct Impl;
  Impl& impl() { return *impl_; }

 private:
  std::unique_ptr<Impl> impl_;
};

/// A file descriptor that another thread makes readable. The thread that waits for it calls clear()
/// before it looks at what the others may have left.
class Wakeup {
 public:
  Wakeup();
  ~Wakeup();
  Wakeup(const Wakeup&) = delete;
  Wakeup& operator=(const Wakeup&) = delete;
  /// Makes the descriptor readable; may be called by any thread.
  void signal();
  void clear();
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
  /// Signalled and not cleared since; then another signal needs no system call.
  std::atomic<bool> is_signalled_{false};
};

/// A socket that wait_readable() can wait for. Asking ZeroMQ about a socket takes system calls,
/// even if no message is there; so it is asked only when there may be one.
class Readable {
 public:
  virtual ~Readable() = default;

 protected:
  Readable() = default;
  Readable(Readable&&) = default;

 private:
  friend class Connection;
  friend class Inbox;
  friend void wait_readable(std::span<Readable* const>, std::span<const int>,
                            std::chrono::milliseconds);
  virtual void* socket() = 0;

  /// Becomes readable when a message may have come, and stays so until the socket is used.
  int descriptor_ = -1;
  /// No message was there, and the socket hasn't been used since.
  bool is_drained_ = false;
};

/// Whether one wants to know what becomes of a connection.
enum class Watch : bool { kNo, kYes };

/// The connecting end (DEALER).
class Connection : public Readable {
 public:
  /// Connecting itself never fails: messages wait until the peer is there. A TCP endpoint needs
  /// `access`, and a local socket has none: anything else is a TransportError.
  Connection(ZmqContext& context, const std::string& endpoint,
             const std::optional<CurveAccess>& access = std::nullopt, Watch watch = Watch::kNo);
  ~Connection() override;
  Connection(Connection&&) noexcept;
  /// Never blocks; messages queue while the peer isn't there.
  void send(Message message);
  /// Nothing when no message is waiting.
  std::optional<Message> receive();
  /// Like receive(), without a copy: the view's frame is valid until the next call.
  std::optional<MessageView> receive_view();
  /// Like receive(), but waits for up to `timeout`.
  std::optional<Message> receive(std::chrono::milliseconds timeout);
  /// The next two tell what becomes of a connection that is watched (Watch::kYes). They are to be
  /// asked every now and then, as what happens is kept until then.
  ///
  /// Whether the peer's process, once it was reached, has closed the connection since, as it does
  /// when it dies, or the network has been gone for long. What was sent to it and not answered is
  /// lost then.
  bool is_lost();
  /// Why the peer hasn't been reached so far; nothing while that may still come by itself, and once
  /// it was. kNobody and kSilent may pass, the others don't.
  std::optional<HandshakeTrouble> trouble();

 private:
  void* socket() override;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A TCP endpoint of an inbox ("tcp://10.0.0.3:*", or "tcp://*:7411"): whoever connects must hold
/// a key that the context's Doorkeeper lets into the domain.
struct KeyedDoor {
  std::string endpoint;
  CurvePair keys;
  std::string domain;
};

/// The listening end (ROUTER): at a local socket, at a TCP port, or at both.
class Inbox : public Readable {
 public:
  /// Throws TransportError when the endpoint can't be bound, also when somebody answers there
  /// already, and when it isn't a local socket's ("ipc:///path"). That can be used by its owner
  /// alone, whatever the process's umask is.
  Inbox(ZmqContext& context, const std::string& endpoint, const PeerLimits& limits = {});
  Inbox(ZmqContext& context, const KeyedDoor& door, const PeerLimits& limits = {});
  Inbox(ZmqContext& context, const std::string& endpoint, const KeyedDoor& door,
        const PeerLimits& limits = {});
  ~Inbox() override;
  struct Received {
    std::string peer;
    /// Its frame is valid until the next call of receive().
    MessageView message;
    PeerKey key = PeerKey::kNone;
  };
  std::optional<Received> receive();
  /// Sends to a peer that has sent something before; the message is dropped if it has gone.
  void send(const std::string& peer, Message message);
  /// The endpoint bound, the local one if there is one; the TCP one, with the port that was picked,
  /// empty if there is none.
  const std::string& endpoint() const;
  const std::string& tcp_endpoint() const;

  /// From now on take_refusals() tells who was hung up on at the TCP port; it is to be asked every
  /// now and then, as what happens is kept until then.
  void watch_refusals();
  std::vector<TurnedAway> take_refusals();

 private:
  void* socket() override;
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Waits until one of the sockets or descriptors may be readable, or the time is up. An
/// interrupting signal ends the wait early.
void wait_readable(std::span<Readable* const> sockets, std::span<const int> descriptors,
                   std::chrono::milliseconds timeout);

}  // namespace graycube
