#include "transport/zmq_sockets.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "check.hpp"
#include "transport/connection_watch.hpp"
#include "transport/refusal_watch.hpp"
#include "transport/tcp_options.hpp"
#include "transport/zmq_context.hpp"

namespace graycube {
namespace {

/// How long unsent messages hold a closing socket up. Goodbyes are acknowledged, so nothing that
/// matters is under way by then.
constexpr int kLinger_ms = 500;

void configure(zmq::socket_t& socket, const PeerLimits& limits) {
  socket.set(zmq::sockopt::sndhwm, limits.unsent);
  socket.set(zmq::sockopt::rcvhwm, limits.unread);
  socket.set(zmq::sockopt::linger, kLinger_ms);
  socket.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(limits.frame_bytes));
}

/// Creates files that only their owner may use as long as it lives. The mask is the process's, so
/// no other thread should create files meanwhile.
class OwnerOnly {
 public:
  OwnerOnly() : before_(::umask(0177)) {}
  ~OwnerOnly() { ::umask(before_); }
  OwnerOnly(const OwnerOnly&) = delete;
  OwnerOnly& operator=(const OwnerOnly&) = delete;

 private:
  mode_t before_;
};

/// Without descriptors or memory for it, a TransportError.
zmq::socket_t open(zmq::context_t& context, zmq::socket_type type, const std::string& endpoint) {
  try {
    return {context, type};
  } catch (const zmq::error_t& e) {
    throw TransportError(endpoint + ": " + e.what());
  }
}

std::span<const std::byte> bytes_of(const zmq::message_t& m) {
  return {static_cast<const std::byte*>(m.data()), m.size()};
}

Bytes copy_of(std::span<const std::byte> bytes) { return Bytes(bytes.begin(), bytes.end()); }

SharedBytes shared(zmq::message_t frame) {
  auto owner = std::make_shared<const zmq::message_t>(std::move(frame));
  return {owner, bytes_of(*owner)};
}

/// Shorter frames are copied, which is cheaper than handing them over.
constexpr std::size_t kShortFrame = 512;

/// A frame whose bytes ZeroMQ releases once it is sent, from a thread of its own.
zmq::message_t frame_of(SharedBytes shared) {
  const auto bytes = shared.bytes();
  if (bytes.size() < kShortFrame) return {bytes.data(), bytes.size()};
  auto owned = std::make_unique<SharedBytes>(std::move(shared));
  // ZeroMQ only reads a frame that is sent, so the cast is safe.
  zmq::message_t frame(
      const_cast<std::byte*>(bytes.data()), bytes.size(),
      [](void*, void* hint) { delete static_cast<SharedBytes*>(hint); }, owned.get());
  // From here on the message owns it.
  static_cast<void>(owned.release());
  return frame;
}

void send_frames(zmq::socket_t& socket, Message message) {
  const bool has_payload = !message.payload.empty();
  socket.send(frame_of(std::move(message.frame)),
              has_payload ? zmq::send_flags::sndmore : zmq::send_flags::none);
  if (has_payload) socket.send(frame_of(std::move(message.payload)), zmq::send_flags::none);
}

/// Whether a message is waiting; nothing when a signal interrupted the question.
std::optional<bool> has_message(zmq::socket_ref socket) {
  try {
    return (socket.get(zmq::sockopt::events) & ZMQ_POLLIN) != 0;
  } catch (const zmq::error_t& e) {
    GRAYCUBE_CHECK(e.num() == EINTR, "ZMQ_EVENTS: %s", e.what());
    return std::nullopt;
  }
}

/// All frames of a message that is waiting; none when none is. Signals don't end it.
void receive_frames(zmq::socket_t& socket, std::vector<zmq::message_t>& frames) {
  frames.clear();
  for (;;) {
    zmq::message_t frame;
    try {
      if (!socket.recv(frame, zmq::recv_flags::dontwait)) return;
    } catch (const zmq::error_t& e) {
      if (e.num() == EINTR) continue;
      throw;
    }
    const bool more = frame.more();
    frames.push_back(std::move(frame));
    if (!more) return;
  }
}

/// Frames from `first` on as a message: one or two of them, else nothing. The payload's frame is
/// taken.
std::optional<MessageView> message_of(std::vector<zmq::message_t>& frames, std::size_t first) {
  if (frames.size() <= first || frames.size() > first + 2) return std::nullopt;
  MessageView m;
  m.frame = bytes_of(frames[first]);
  if (frames.size() == first + 2) m.payload = shared(std::move(frames[first + 1]));
  return m;
}

}  // namespace

ZmqContext::ZmqContext() : impl_(std::make_unique<Impl>()) {}
ZmqContext::~ZmqContext() = default;

Wakeup::Wakeup() : descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (descriptor_ < 0) throw TransportError(std::string("eventfd: ") + std::strerror(errno));
}
Wakeup::~Wakeup() { ::close(descriptor_); }

void Wakeup::signal() {
  if (is_signalled_.exchange(true)) return;
  const std::uint64_t one = 1;
  // It can only fail when the counter is full, and then the descriptor is readable already.
  [[maybe_unused]] const auto written = ::write(descriptor_, &one, sizeof one);
}
void Wakeup::clear() {
  is_signalled_ = false;
  std::uint64_t count = 0;
  [[maybe_unused]] const auto taken = ::read(descriptor_, &count, sizeof count);
}

struct Connection::Impl {
  Impl(zmq::context_t& c, const std::string& endpoint)
      : context(c), socket(open(c, zmq::socket_type::dealer, endpoint)) {}
  void take_events() {
    const auto now = ConnectionWatch::Clock::now();
    while (const auto event = monitor ? monitor->next() : std::nullopt) watch.on_event(*event, now);
  }
  zmq::context_t& context;
  zmq::socket_t socket;
  /// The frames of the message received last.
  std::vector<zmq::message_t> frames;
  ConnectionWatch watch;
  std::optional<SocketMonitor> monitor;
};

Connection::Connection(ZmqContext& context, const std::string& endpoint,
                       const std::optional<CurveAccess>& access, Watch watch)
    : impl_(std::make_unique<Impl>(context.impl().context, endpoint)) {
  if (is_tcp(endpoint) != access.has_value()) throw TransportError(endpoint + ": " + kKeysAtTcp);
  try {
    configure(impl_->socket, {});
    if (access) make_keyed(impl_->socket, endpoint, *access);
    descriptor_ = impl_->socket.get(zmq::sockopt::fd);
    // Before anything can happen that it should hear of.
    if (watch == Watch::kYes)
      impl_->monitor.emplace(impl_->context, impl_->socket, ConnectionWatch::events());
    impl_->socket.connect(endpoint);
  } catch (const zmq::error_t& e) {
    throw TransportError(endpoint + ": " + e.what());
  }
}
Connection::~Connection() = default;
Connection::Connection(Connection&&) noexcept = default;

void Connection::send(Message message) {
  is_drained_ = false;
  send_frames(impl_->socket, std::move(message));
}

std::optional<Message> Connection::receive() {
  const auto view = receive_view();
  if (!view) return std::nullopt;
  return Message{copy_of(view->frame), view->payload};
}

std::optional<MessageView> Connection::receive_view() {
  if (is_drained_) return std::nullopt;
  std::vector<zmq::message_t>& frames = impl_->frames;
  receive_frames(impl_->socket, frames);
  is_drained_ = frames.empty();
  return message_of(frames, 0);
}

std::optional<Message> Connection::receive(std::chrono::milliseconds timeout) {
  const auto until = std::chrono::steady_clock::now() + timeout;
  for (;;) {
    if (auto message = receive()) return message;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        until - std::chrono::steady_clock::now());
    if (left.count() <= 0) return std::nullopt;
    Readable* const self = this;
    wait_readable({&self, 1}, {}, left);
  }
}

bool Connection::is_lost() {
  impl_->take_events();
  return impl_->watch.is_lost();
}

std::optional<HandshakeTrouble> Connection::trouble() {
  impl_->take_events();
  return impl_->watch.trouble(ConnectionWatch::Clock::now());
}

void* Connection::socket() { return impl_->socket.handle(); }

struct Inbox::Impl {
  Impl(zmq::context_t& c, const std::string& at, const PeerLimits& peers)
      : context(c), socket(open(c, zmq::socket_type::router, at)), limits(peers) {
    try {
      configure(socket, limits);
      socket.set(zmq::sockopt::handshake_ivl, limits.handshake_ms);
      descriptor = socket.get(zmq::sockopt::fd);
    } catch (const zmq::error_t& e) {
      throw TransportError(at + ": " + e.what());
    }
  }
  void bind(const std::string& at, std::string& bound) {
    try {
      const OwnerOnly owner_only;
      socket.bind(at);
      bound = socket.get(zmq::sockopt::last_endpoint);
    } catch (const zmq::error_t& e) {
      throw TransportError(at + ": " + e.what());
    }
  }
  void bind_local(const std::string& at) {
    if (is_tcp(at)) throw TransportError(at + ": " + kKeysAtTcp);
    bind(at, local);
  }
  /// What is set for TCP holds for endpoints that are bound later.
  void bind_tcp(const KeyedDoor& door) {
    if (!is_tcp(door.endpoint)) throw TransportError(door.endpoint + ": " + kKeysAtTcp);
    try {
      make_keyed_door(socket, door);
    } catch (const zmq::error_t& e) {
      throw TransportError(door.endpoint + ": " + e.what());
    }
    bind(door.endpoint, tcp);
  }

  zmq::context_t& context;
  zmq::socket_t socket;
  PeerLimits limits;
  int descriptor = -1;
  std::string local, tcp;
  /// The frames of the message received last.
  std::vector<zmq::message_t> frames;
  RefusalWatch refusals;
  std::optional<SocketMonitor> monitor;
};

Inbox::Inbox(ZmqContext& context, const std::string& endpoint, const PeerLimits& limits)
    : impl_(std::make_unique<Impl>(context.impl().context, endpoint, limits)) {
  descriptor_ = impl_->descriptor;
  impl_->bind_local(endpoint);
}
Inbox::Inbox(ZmqContext& context, const KeyedDoor& door, const PeerLimits& limits)
    : impl_(std::make_unique<Impl>(context.impl().context, door.endpoint, limits)) {
  descriptor_ = impl_->descriptor;
  impl_->bind_tcp(door);
}
Inbox::Inbox(ZmqContext& context, const std::string& endpoint, const KeyedDoor& door,
             const PeerLimits& limits)
    : Inbox(context, endpoint, limits) {
  impl_->bind_tcp(door);
}
Inbox::~Inbox() {
  // libzmq may leave the file of a local socket behind.
  if (impl_->local.starts_with("ipc://")) ::unlink(impl_->local.c_str() + 6);
}

std::optional<Inbox::Received> Inbox::receive() {
  while (!is_drained_) {
    std::vector<zmq::message_t>& frames = impl_->frames;
    receive_frames(impl_->socket, frames);
    is_drained_ = frames.empty();
    // Anything but one or two frames is not of this protocol.
    if (const auto message = message_of(frames, 1))
      return Received{frames.front().to_string(), *message,
                      impl_->tcp.empty() ? PeerKey::kNone : key_of_sender(frames.back())};
  }
  return std::nullopt;
}

void Inbox::send(const std::string& peer, Message message) {
  is_drained_ = false;
  impl_->socket.send(zmq::buffer(peer), zmq::send_flags::sndmore);
  send_frames(impl_->socket, std::move(message));
}

const std::string& Inbox::endpoint() const {
  return impl_->local.empty() ? impl_->tcp : impl_->local;
}
const std::string& Inbox::tcp_endpoint() const { return impl_->tcp; }

void Inbox::watch_refusals() {
  impl_->monitor.emplace(impl_->context, impl_->socket, RefusalWatch::events());
}

std::vector<TurnedAway> Inbox::take_refusals() {
  std::vector<TurnedAway> taken;
  while (const auto event = impl_->monitor ? impl_->monitor->next() : std::nullopt) {
    if (auto refusal = impl_->refusals.on_event(*event, address_of_peer))
      taken.push_back(*std::move(refusal));
  }
  return taken;
}

void* Inbox::socket() { return impl_->socket.handle(); }

// zmq::poll would ask each socket before and after it waits. This waits for the sockets'
// descriptors instead (see ZMQ_FD): a descriptor tells once that something happened to its socket,
// and doesn't tell of messages that came while the socket was used.
void wait_readable(std::span<Readable* const> sockets, std::span<const int> descriptors,
                   std::chrono::milliseconds timeout) {
  std::vector<pollfd> items;
  for (Readable* readable : sockets) {
    if (!readable->is_drained_) {
      const auto found = has_message(zmq::socket_ref(zmq::from_handle, readable->socket()));
      if (!found || *found) return;
      readable->is_drained_ = true;
    }
    items.push_back({readable->descriptor_, POLLIN, 0});
  }
  for (const int d : descriptors) items.push_back({d, POLLIN, 0});
  const int ready = ::poll(items.data(), items.size(), static_cast<int>(timeout.count()));
  GRAYCUBE_CHECK(ready >= 0 || errno == EINTR, "poll: %s", std::strerror(errno));
  if (ready <= 0) return;
  for (std::size_t i = 0; i < sockets.size(); ++i) {
    if (items[i].revents != 0) sockets[i]->is_drained_ = false;
  }
}

}  // namespace graycube
