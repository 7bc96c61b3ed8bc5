#include "transport/zmq_sockets.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "check.hpp"
#include "transport/doorkeeper.hpp"
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
  zmq::context_t& context;
  zmq::socket_t socket;
  /// The frames of the message received last.
  std::vector<zmq::message_t> frames;
  /// Where ZeroMQ tells that the connection is closed, once that is watched.
  std::optional<zmq::socket_t> losses;
  bool is_lost = false;
};

Connection::Connection(ZmqContext& context, const std::string& endpoint, const std::string& key)
    : impl_(std::make_unique<Impl>(context.impl().context, endpoint)) {
  try {
    configure(impl_->socket, {});
    if (!key.empty()) {
      impl_->socket.set(zmq::sockopt::plain_username, kKeyUser);
      impl_->socket.set(zmq::sockopt::plain_password, key);
    }
    descriptor_ = impl_->socket.get(zmq::sockopt::fd);
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

void Connection::watch_loss() {
  // A name that no other watched connection of this process has.
  static std::atomic<std::uint64_t> watched{0};
  const std::string endpoint = "inproc://losses-" + std::to_string(watched.fetch_add(1));
  try {
    if (zmq_socket_monitor(impl_->socket.handle(), endpoint.c_str(), ZMQ_EVENT_DISCONNECTED) != 0)
      throw zmq::error_t();
    impl_->losses.emplace(impl_->context, zmq::socket_type::pair);
    impl_->losses->set(zmq::sockopt::linger, 0);
    impl_->losses->connect(endpoint);
  } catch (const zmq::error_t& e) {
    throw TransportError(endpoint + ": " + e.what());
  }
}

bool Connection::is_lost() {
  std::vector<zmq::message_t> frames;
  if (!impl_->is_lost && impl_->losses) {
    receive_frames(*impl_->losses, frames);
    // Nothing else is told there.
    impl_->is_lost = !frames.empty();
  }
  return impl_->is_lost;
}

void* Connection::socket() { return impl_->socket.handle(); }

struct Inbox::Impl {
  Impl(zmq::context_t& context, const std::string& at)
      : socket(open(context, zmq::socket_type::router, at)) {}
  zmq::socket_t socket;
  std::string endpoint;
  /// The frames of the message received last.
  std::vector<zmq::message_t> frames;
};

Inbox::Inbox(ZmqContext& context, const std::string& endpoint, const PeerLimits& limits,
             bool wants_key)
    : impl_(std::make_unique<Impl>(context.impl().context, endpoint)) {
  try {
    configure(impl_->socket, limits);
    impl_->socket.set(zmq::sockopt::handshake_ivl, limits.handshake_ms);
    if (wants_key) impl_->socket.set(zmq::sockopt::plain_server, true);
    descriptor_ = impl_->socket.get(zmq::sockopt::fd);
    const OwnerOnly owner_only;
    impl_->socket.bind(endpoint);
    impl_->endpoint = impl_->socket.get(zmq::sockopt::last_endpoint);
  } catch (const zmq::error_t& e) {
    throw TransportError(endpoint + ": " + e.what());
  }
}
Inbox::~Inbox() {
  // libzmq may leave the file of a local socket behind.
  if (impl_->endpoint.starts_with("ipc://")) ::unlink(impl_->endpoint.c_str() + 6);
}

std::optional<Inbox::Received> Inbox::receive() {
  while (!is_drained_) {
    std::vector<zmq::message_t>& frames = impl_->frames;
    receive_frames(impl_->socket, frames);
    is_drained_ = frames.empty();
    // Anything but one or two frames is not of this protocol.
    if (const auto message = message_of(frames, 1))
      return Received{frames.front().to_string(), *message};
  }
  return std::nullopt;
}

void Inbox::send(const std::string& peer, Message message) {
  is_drained_ = false;
  impl_->socket.send(zmq::buffer(peer), zmq::send_flags::sndmore);
  send_frames(impl_->socket, std::move(message));
}

const std::string& Inbox::endpoint() const { return impl_->endpoint; }
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
