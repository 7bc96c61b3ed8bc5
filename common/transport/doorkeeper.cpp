#include "transport/doorkeeper.hpp"

#include <array>
#include <atomic>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "transport/same_secret_text.hpp"
#include "transport/zmq_context.hpp"

namespace graycube {
namespace {

/// Where ZeroMQ asks, and where the thread is told to end; both inside this process.
constexpr const char* kAskedAt = "inproc://zeromq.zap.01";
constexpr const char* kEndAt = "inproc://graycube.doorkeeper.end";

/// Frames of a question: version, its number, domain, address, identity, mechanism, and what the
/// mechanism adds: with PLAIN a user name and a password.
enum Frame : std::size_t { kVersion, kNumber, kMechanism = 5, kUser, kPassword, kFrames };

std::vector<zmq::message_t> question_at(zmq::socket_t& asked) {
  std::vector<zmq::message_t> frames;
  do {
    frames.emplace_back();
    if (!asked.recv(frames.back(), zmq::recv_flags::none)) return {};
  } while (frames.back().more());
  return frames;
}

void answer(zmq::socket_t& asked, const std::vector<zmq::message_t>& question, bool opens) {
  const std::string_view number =
      question.size() > kNumber ? question[kNumber].to_string_view() : std::string_view();
  const std::array<std::string_view, 6> frames{
      "1.0", number, opens ? "200" : "400", opens ? "OK" : "no key of this farm", "", ""};
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const bool more = i + 1 < frames.size();
    asked.send(zmq::buffer(frames[i]), more ? zmq::send_flags::sndmore : zmq::send_flags::none);
  }
}

}  // namespace

struct Doorkeeper::Impl {
  Impl(zmq::context_t& context, std::string farm_key)
      : key(std::move(farm_key)),
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
        const bool is_let_in = opens(question);
        if (!is_let_in) ++refused;
        answer(asked, question, is_let_in);
      } catch (const zmq::error_t& e) {
        if (e.num() != EINTR) return;
      }
    }
  }

  bool opens(const std::vector<zmq::message_t>& question) const {
    return question.size() == kFrames && question[kVersion].to_string_view() == "1.0" &&
           question[kMechanism].to_string_view() == "PLAIN" &&
           question[kUser].to_string_view() == kKeyUser &&
           is_same_secret_text(question[kPassword].to_string_view(), key);
  }

  std::string key;
  std::atomic<std::uint64_t> refused{0};
  zmq::socket_t asked, ending, end;
  std::thread thread;
};

Doorkeeper::Doorkeeper(ZmqContext& context, std::string key) {
  try {
    impl_ = std::make_unique<Impl>(context.impl().context, std::move(key));
  } catch (const zmq::error_t& e) {
    throw TransportError(std::string(kAskedAt) + ": " + e.what());
  }
}
Doorkeeper::~Doorkeeper() = default;

std::uint64_t Doorkeeper::take_refused() { return impl_->refused.exchange(0); }

}  // namespace graycube
