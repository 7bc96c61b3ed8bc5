#include "transport/zmq_sockets.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <zmq.hpp>

#include "geometry/check.hpp"

namespace graycube {
namespace {

constexpr int kNoLimit = 0;
/// How long unsent messages hold a closing socket up. Goodbyes are acknowledged, so nothing that matters is
/// under way by then.
constexpr int kLinger_ms = 500;

void configure(zmq::socket_t& socket) {
  socket.set(zmq::sockopt::sndhwm, kNoLimit);
  socket.set(zmq::sockopt::rcvhwm, kNoLimit);
  socket.set(zmq::sockopt::linger, kLinger_ms);
  socket.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(kMaxMessageBytes));
}

Bytes bytes_of(const zmq::message_t& m) {
  const auto* data = static_cast<const std::byte*>(m.data());
  return Bytes(data, data + m.size());
}

void send_frames(zmq::socket_t& socket, const Message& message) {
  const bool has_payload = !message.payload.empty();
  socket.send(zmq::buffer(message.frame.data(), message.frame.size()),
              has_payload ? zmq::send_flags::sndmore : zmq::send_flags::none);
  if (has_payload) {
    socket.send(zmq::buffer(message.payload.data(), message.payload.size()), zmq::send_flags::none);
  }
}

/// All frames of a message that is waiting; none when none is. Signals don't end it.
std::vector<zmq::message_t> receive_frames(zmq::socket_t& socket) {
  std::vector<zmq::message_t> frames;
  for (;;) {
    zmq::message_t frame;
    try {
      if (!socket.recv(frame, zmq::recv_flags::dontwait)) return frames;
    } catch (const zmq::error_t& e) {
      if (e.num() == EINTR) continue;
      throw;
    }
    const bool more = frame.more();
    frames.push_back(std::move(frame));
    if (!more) return frames;
  }
}

/// Frames from `first` on as a message: one or two of them, else nothing.
std::optional<Message> message_of(const std::vector<zmq::message_t>& frames, std::size_t first) {
  if (frames.size() <= first || frames.size() > first + 2) return std::nullopt;
  Message m;
  m.frame = bytes_of(frames[first]);
  if (frames.size() == first + 2) m.payload = bytes_of(frames[first + 1]);
  return m;
}

}  // namespace

struct ZmqContext::Impl {
  zmq::context_t context{1};
};

ZmqContext::ZmqContext() : impl_(std::make_unique<Impl>()) {}
ZmqContext::~ZmqContext() = default;

Wakeup::Wakeup() : descriptor_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
  if (descriptor_ < 0) throw TransportError(std::string("eventfd: ") + std::strerror(errno));
}
Wakeup::~Wakeup() { ::close(descriptor_); }

void Wakeup::signal() {
  const std::uint64_t one = 1;
  // It can only fail when the counter is full, and then the descriptor is readable already.
  [[maybe_unused]] const auto written = ::write(descriptor_, &one, sizeof one);
}
void Wakeup::clear() {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto taken = ::read(descriptor_, &count, sizeof count);
}

struct Connection::Impl {
  explicit Impl(zmq::context_t& context) : socket(context, zmq::socket_type::dealer) {}
  zmq::socket_t socket;
};

Connection::Connection(ZmqContext& context, const std::string& endpoint)
    : impl_(std::make_unique<Impl>(context.impl().context)) {
  try {
    configure(impl_->socket);
    impl_->socket.connect(endpoint);
  } catch (const zmq::error_t& e) {
    throw TransportError(endpoint + ": " + e.what());
  }
}
Connection::~Connection() = default;
Connection::Connection(Connection&&) noexcept = default;

void Connection::send(const Message& message) { send_frames(impl_->socket, message); }

std::optional<Message> Connection::receive() {
  return message_of(receive_frames(impl_->socket), 0);
}

std::optional<Message> Connection::receive(std::chrono::milliseconds timeout) {
  const auto until = std::chrono::steady_clock::now() + timeout;
  for (;;) {
    if (auto message = receive()) return message;
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        until - std::chrono::steady_clock::now());
    if (left.count() <= 0) return std::nullopt;
    void* const socket = raw();
    wait_readable({&socket, 1}, {}, left);
  }
}

void* Connection::raw() { return impl_->socket.handle(); }

struct Inbox::Impl {
  explicit Impl(zmq::context_t& context) : socket(context, zmq::socket_type::router) {}
  zmq::socket_t socket;
  std::string endpoint;
};

Inbox::Inbox(ZmqContext& context, const std::string& endpoint)
    : impl_(std::make_unique<Impl>(context.impl().context)) {
  try {
    configure(impl_->socket);
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
  for (;;) {
    const auto frames = receive_frames(impl_->socket);
    if (frames.empty()) return std::nullopt;
    // Anything but one or two frames is not of this protocol.
    if (auto message = message_of(frames, 1)) {
      return Received{frames.front().to_string(), std::move(*message)};
    }
  }
}

void Inbox::send(const std::string& peer, const Message& message) {
  impl_->socket.send(zmq::buffer(peer), zmq::send_flags::sndmore);
  send_frames(impl_->socket, message);
}

const std::string& Inbox::endpoint() const { return impl_->endpoint; }
void* Inbox::raw() { return impl_->socket.handle(); }

void wait_readable(std::span<void* const> sockets, std::span<const int> descriptors,
                   std::chrono::milliseconds timeout) {
  std::vector<zmq::pollitem_t> items;
  for (void* s : sockets) items.push_back({s, 0, ZMQ_POLLIN, 0});
  for (const int d : descriptors) items.push_back({nullptr, d, ZMQ_POLLIN, 0});
  try {
    zmq::poll(items, timeout);
  } catch (const zmq::error_t& e) {
    GRAYCUBE_CHECK(e.num() == EINTR, "zmq::poll: %s", e.what());
  }
}

}  // namespace graycube
