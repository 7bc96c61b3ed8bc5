#include "cli/farm/client.hpp"

#include <algorithm>
#include <utility>

#include "cli/farm/door.hpp"
#include "cli/farm/listener.hpp"
#include "cli/interrupts.hpp"
#include "proto/control.hpp"
#include "transport/farm_key.hpp"

namespace graycube {
namespace {

constexpr std::chrono::milliseconds kCheckInterval{100};
/// A frontal that is back so soon after its end isn't missed.
constexpr std::chrono::milliseconds kNoticed{300};

ExitStatus status_of(FailureCode code) {
  switch (code) {
    case FailureCode::kBadInput:
    case FailureCode::kTooLarge:
    case FailureCode::kUnknownJob: return ExitStatus::kBadInput;
    default: return ExitStatus::kFailed;
  }
}

}  // namespace

Failure failure_of(const control::Failed& failed, const std::string& what) {
  const std::string job = failed.job == 0 ? "" : "job " + std::to_string(failed.job);
  std::vector<Problem> problems;
  for (const control::ErrorItem& e : failed.errors) {
    problems.push_back({what, e.where.empty() ? job : e.where, e.why});
  }
  if (problems.empty()) problems.push_back({what, job, std::string(to_string(failed.code))});
  return Failure(status_of(failed.code), std::move(problems))
      .told_by_farm(failed.code == FailureCode::kDeadlock, failed.stats ? failed.stats->text : "");
}

FarmClient::FarmClient(const FarmAddress& farm, std::function<void()> check)
    : endpoint_(farm.endpoint), access_(access_to(farm)), check_(std::move(check)) {
  connect();
}

void FarmClient::connect() { connection_.emplace(context_, endpoint_, access_, Watch::kYes); }

void FarmClient::send(const ControlMessage& message, SharedBytes payload) {
  last_ = Message::of_text(encode(message), std::move(payload));
  connection_->send(last_);
}

void FarmClient::go_on_after_loss() {
  if (!waits_for_restart_ || !connection_->is_lost()) return;
  if (Clock::now() - connected_at_ < kCheckInterval) return;
  // A new connection has a new name, so that late answers of the old one can't come.
  connect();
  connected_at_ = Clock::now();
  if (!last_.frame.empty()) {
    connection_->send(last_);
    has_asked_again_ = true;
  }
  if (!lost_at_) lost_at_ = Clock::now();
}

FarmClient::Clock::time_point FarmClient::end_of_wait(Clock::time_point until) const {
  if (!lost_at_ || !has_answered_) return until;
  return std::max<Clock::time_point>(until, *lost_at_ + kRestartWait);
}

std::optional<Received> FarmClient::receive(Clock::duration timeout) {
  const auto until = Clock::now() + timeout;
  for (;;) {
    check_();
    if (auto message = connection_->receive()) {
      auto decoded = decode(message->text());
      // A message that can't be read, perhaps from a newer frontal, answers none of our questions.
      if (auto* control = std::get_if<ControlMessage>(&decoded)) {
        has_answered_ = true;
        lost_at_.reset();
        return Received{std::move(*control), std::move(message->payload)};
      }
      continue;
    }
    if (is_turned_away()) return std::nullopt;
    go_on_after_loss();
    const auto now = Clock::now();
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(end_of_wait(until) - now);
    if (left.count() <= 0) return std::nullopt;
    if (lost_at_ && has_answered_ && now - *lost_at_ > kNoticed &&
        !std::exchange(has_said_so_, true)) {
      print({"farm", endpoint_,
             "its frontal has gone; waiting up to " + std::to_string(kRestartWait.count()) +
                 " s for another"});
    }
    Readable* const sockets[] = {&*connection_};
    const int descriptors[] = {wakeup_descriptor()};
    const std::size_t known = descriptors[0] >= 0 ? 1 : 0;
    wait_readable(sockets, std::span(descriptors, known), std::min(left, kCheckInterval));
    if (known != 0) clear_wakeup();
  }
}

Received FarmClient::answer() {
  if (auto received = receive(has_answered_ ? kLaterAnswer : kFirstAnswer))
    return *std::move(received);
  // A farm under load is slow to answer; if a process listens there, it gets more time.
  if (!has_answered_ && may_be_slow()) {
    if (auto received = receive(kLaterAnswer)) return *std::move(received);
  }
  throw silence();
}

bool FarmClient::is_turned_away() {
  const auto trouble = connection_->trouble();
  return trouble && *trouble != HandshakeTrouble::kNobody && *trouble != HandshakeTrouble::kSilent;
}

bool FarmClient::may_be_slow() {
  // Elsewhere only the connection itself tells.
  return needs_key(endpoint_) ? !connection_->trouble() : find_listener(endpoint_).is_there;
}

Failure FarmClient::silence() {
  const auto trouble = connection_->trouble();
  const bool is_missing = !trouble || *trouble == HandshakeTrouble::kNobody;
  return {ExitStatus::kFailed, Problem{"farm", endpoint_,
                                       !is_missing     ? sentence_of(*trouble)
                                       : has_answered_ ? "it answers no longer"
                                       : trouble ? "nobody answers; start one with 'graycube up'"
                                                 : "somebody listens there, but doesn't answer"}};
}

}  // namespace graycube
