// A conversation with a farm's frontal.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "cli/failure.hpp"
#include "cli/farm/address.hpp"
#include "proto/messages.hpp"
#include "transport/zmq_sockets.hpp"

namespace graycube {

/// How long a frontal may take to answer for the first time, and how long for later answers.
inline constexpr std::chrono::seconds kFirstAnswer{2};
inline constexpr std::chrono::seconds kLaterAnswer{30};

struct Received {
  ControlMessage message;
  SharedBytes payload;
};

/// The failure that a `failed` message reports to the user: `what: where: why` for each error.
Failure failure_of(const control::Failed& failed, const std::string& what);

class FarmClient {
 public:
  using Clock = std::chrono::steady_clock;

  /// Throws a Failure when somebody else may listen there (door.hpp). `check` is called every now
  /// and then during a wait, and may throw to end that.
  explicit FarmClient(
      const FarmAddress& farm, std::function<void()> check = [] {});

  const std::string& endpoint() const { return endpoint_; }
  void send(const ControlMessage& message, SharedBytes payload = {});
  /// The next control message; nothing when the time is up.
  std::optional<Received> receive(Clock::duration timeout);

  /// The answer to a message; other messages are dropped. Throws the Failure that a `failed` answer
  /// reports, whose lines begin with `what`, or that of a farm that doesn't answer.
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
  /// The next message; throws silence() when none comes in time.
  Received answer();

  std::string endpoint_;
  std::function<void()> check_;
  ZmqContext context_;
  Connection connection_;
  bool has_answered_ = false;
};

}  // namespace graycube
