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
/// How long a client waits for a frontal to be started again, once one that has answered has died.
inline constexpr std::chrono::seconds kRestartWait{60};

struct Received {
  ControlMessage message;
  SharedBytes payload;
};

/// The failure that a `failed` message reports to the user: `what: where: why` for each error.
Failure failure_of(const control::Failed& failed, const std::string& what);

/// Requests go unanswered when the frontal dies. The client then connects again, to whichever
/// frontal listens at the endpoint next, and asks again what it asked last: so every request must
/// be one that may be repeated (proto/FORMAT.md). It says once that it waits.
class FarmClient {
 public:
  using Clock = std::chrono::steady_clock;

  /// Throws a Failure when somebody else may listen there (door.hpp). `check` is called every now
  /// and then during a wait, and may throw to end that.
  explicit FarmClient(
      const FarmAddress& farm, std::function<void()> check = [] {});

  const std::string& endpoint() const { return endpoint_; }
  void send(const ControlMessage& message, SharedBytes payload = {});
  /// As after `down`: the frontal's end is expected, and no other is waited for.
  void expect_end() { waits_for_restart_ = false; }
  /// Whether a request was repeated, so that the frontal may have granted it before.
  bool has_asked_again() const { return has_asked_again_; }
  /// The next control message; nothing when the time is up, or when it is clear that none comes.
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
        last_ = {};
        return {std::move(*reply), std::move(received.payload)};
      }
      if (const auto* failed = std::get_if<control::Failed>(&received.message)) {
        throw failure_of(*failed, what);
      }
    }
  }

  /// Why nothing comes.
  Failure silence();

 private:
  /// The next message; throws silence() when none comes in time.
  Received answer();
  /// Whether the farm's end of the connection won't ever answer, whoever waits.
  bool is_turned_away();
  /// Whether a process listens there that may answer yet.
  bool may_be_slow();

  void connect();
  /// Connects anew if the frontal has died, and repeats the last request.
  void go_on_after_loss();
  /// The end of a wait that is to last until `until`; later while a restart is waited for.
  Clock::time_point end_of_wait(Clock::time_point until) const;

  std::string endpoint_;
  std::optional<CurveAccess> access_;
  std::function<void()> check_;
  ZmqContext context_;
  std::optional<Connection> connection_;
  /// What was asked last, until it is answered.
  Message last_;
  bool has_answered_ = false, waits_for_restart_ = true, has_asked_again_ = false,
       has_said_so_ = false;
  /// When the frontal was lost, until another one answers.
  std::optional<Clock::time_point> lost_at_;
  /// When it was connected to the frontal for the last time.
  Clock::time_point connected_at_{};
};

}  // namespace graycube
