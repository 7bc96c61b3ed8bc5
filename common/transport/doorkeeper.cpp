#include "transport/doorkeeper.hpp"

#include <array>
#include <cstring>
#include <string_view>
#include <thread>
#include <utility>

#include "transport/tcp_options.hpp"
#include "transport/zmq_context.hpp"

namespace graycube {
namespace {

/// Where ZeroMQ asks, and where the thread is told to end; both inside this process.
constexpr const char* kAskedAt = "inproc://zeromq.zap.01";
constexpr const char* kEndAt = "inproc://graycube.doorkeeper.end";

/// Frames of a question: version, its number, domain, address, identity, mechanism, and what the
/// mechanism adds: with CURVE the public key, to which the peer has shown to hold the secret one.
enum Frame : std::size_t { kVersion, kNumber, kDomain, kMechanism = 5, kPublicKey, kFrames };

std::vector<zmq::message_t> question_at(zmq::socket_t& asked) {
  std::vector<zmq::message_t> frames;
  do {
    frames.emplace_back();
    if (!asked.recv(frames.back(), zmq::recv_flags::none)) return {};
  } while (frames.back().more());
  return frames;
}

void answer(zmq::socket_t& asked, const std::vector<zmq::message_t>& question, PeerKey who) {
  const std::string_view number =
      question.size() > kNumber ? question[kNumber].to_string_view() : std::string_view();
  const bool opens = who != PeerKey::kNone;
  const std::array<std::string_view, 6> frames{
      "1.0", number, opens ? "200" : "400", opens ? "OK" : "no key of this farm", user_of(who), ""};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool more = i + 1 < frames.size();
    asked.send(zmq::buffer(frames[i]), more ? zmq::send_flags::sndmore : zmq::send_flags::none);
  }
}

}  // namespace

struct Doorkeeper::Impl {
  Impl(zmq::context_t& context, std::vector<Admitted> admitted)
      : list(std::move(admitted)),
        asked(context, zmq::socket_type::rep),
        ending(context, zmq::socket_type::pair),
        end(context, zmq::socket_type::pair) {
    asked.set(zmq::sockopt::linger, 0);
    asked.bind(kAskedAt);
    ending.bind(kEndAt);
    end.connect(kEndAt);
    thread = std::thread([this] { run(); });
  }
  ~Impl() {
    end.send(zmq::message_t(), zmq::send_flags::none);
    thread.join();
  }

  void run() {
    for (;;) {
      std::array<zmq::pollitem_t, 2> items{
          {{asked.handle(), 0, ZMQ_POLLIN, 0}, {ending.handle(), 0, ZMQ_POLLIN, 0}}};
      try {
        zmq::poll(items.data(), items.size(), std::chrono::milliseconds(-1));
        if (items[1].revents != 0) return;
        const std::vector<zmq::message_t> question = question_at(asked);
        answer(asked, question, who_asks(question));
      } catch (const zmq::error_t& e) {
        if (e.num() != EINTR) return;
      }
    }
  }

  /// kNone for those who stay out.
  PeerKey who_asks(const std::vector<zmq::message_t>& question) const {
    if (question.size() != kFrames || question[kVersion].to_string_view() != "1.0" ||
        question[kMechanism].to_string_view() != "CURVE")
      return PeerKey::kNone;
    for (const Admitted& a : list) {
      const zmq::message_t& key = question[kPublicKey];
      if (question[kDomain].to_string_view() == a.domain && key.size() == a.public_key.size() &&
          std::memcmp(key.data(), a.public_key.data(), key.size()) == 0)
        return a.who;
    }
    return PeerKey::kNone;
  }

  std::vector<Admitted> list;
  zmq::socket_t asked, ending, end;
  std::thread thread;
};

Doorkeeper::Doorkeeper(ZmqContext& context, std::vector<Admitted> list) {
  try {
    impl_ = std::make_unique<Impl>(context.impl().context, std::move(list));
  } catch (const zmq::error_t& e) {
    throw TransportError(std::string(kAskedAt) + ": " + e.what());
  }
}
Doorkeeper::~Doorkeeper() = default;

std::vector<Admitted> admitted_to_nodes(const CurvePair& nodes) {
  return {{kNodesDomain, nodes.public_key, PeerKey::kNode}};
}

std::vector<Admitted> admitted_to_door(const FarmKeys& keys) {
  return {{kDoorDomain, keys.nodes.public_key, PeerKey::kNode},
          {kDoorDomain, keys.clients.public_key, PeerKey::kClient},
          {kNodesDomain, keys.nodes.public_key, PeerKey::kNode}};
}

}  // namespace graycube
