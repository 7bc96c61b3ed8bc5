// A conversation with a farm's frontal.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "cli/failure.hpp"
#include "proto/messages.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {

/// How long a frontal may take to answer at all, and to answer somebody it has answered before.
inline constexpr std::chrono::seconds kFirstAnswer{2};
inline constexpr std::chrono::seconds kLaterAnswer{30};

struct Received {
  ControlMessage message;
  SharedBytes payload;
};

/// What a `failed` message is for the user: `what: where: why` for each of its errors.
Failure failure_of(const control::Failed& failed, const std::string& what);

class FarmClient {
 public:
  using Clock = std::chrono::steady_clock;

  /// `check` is called every now and then while waiting, and may throw to end that.
  explicit FarmClient(
      std::string endpoint, std::function<void()> check = [] {});

  const std::string& endpoint() const { return endpoint_; }
  void send(const ControlMessage& message, SharedBytes payload = {});
  /// The next message that is one; nothing when the time is up.
  std::optional<Received> receive(Clock::duration timeout);

  /// The answer to a message, other messages dropped. Throws the Failure that a `failed` answer is,
  /// or the one of a farm that doesn't answer. `what` begins the line of the former.
  template <typename Reply>
  std::pair<Reply, SharedBytes> ask(const ControlMessage& message, const std::string& what,
                                    SharedBytes payload = {}) {
    send(message, std::move(payload));
    for (;;) {
      Received received = answer();
      if (auto* reply = std::get_if<Reply>(&received.message)) {
        return {std::move(*reply), std::move(received.payload)};
      }
      if (const auto* failed = std::get_if<control::Failed>(&received.message)) {
        throw failure_of(*failed, what);
      }
    }
  }

  Failure silence() const;

 private:
  /// The next message; throws silence().
  Received answer();

  std::string endpoint_;
  std::function<void()> check_;
  ZmqContext context_;
  Connection connection_;
  bool has_answered_ = false;
};

}  // namespace graycube
