#include "cli/farm/client.hpp"

#include <algorithm>

#include "cli/farm/door.hpp"
#include "cli/farm/listener.hpp"
#include "cli/interrupts.hpp"
#include "proto/control.hpp"
#include "transport/farm_key.hpp"

namespace graycube {
namespace {

constexpr std::chrono::milliseconds kCheckInterval{100};

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
    : endpoint_(farm.endpoint),
      check_(std::move(check)),
      connection_(context_, endpoint_, key_shown_at(farm)) {}

void FarmClient::send(const ControlMessage& message, SharedBytes payload) {
  connection_.send(Message::of_text(encode(message), std::move(payload)));
}

std::optional<Received> FarmClient::receive(Clock::duration timeout) {
  const auto until = Clock::now() + timeout;
  for (;;) {
    check_();
    if (auto message = connection_.receive()) {
      auto decoded = decode(message->text());
      // A message that can't be read, perhaps from a newer frontal, answers none of our questions.
      if (auto* control = std::get_if<ControlMessage>(&decoded)) {
        has_answered_ = true;
        return Received{std::move(*control), std::move(message->payload)};
      }
      continue;
    }
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now());
    if (left.count() <= 0) return std::nullopt;
    Readable* const sockets[] = {&connection_};
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
  if (!has_answered_ && find_listener(endpoint_).is_there) {
    if (auto received = receive(kLaterAnswer)) return *std::move(received);
  }
  throw silence();
}

Failure FarmClient::silence() const {
  return {ExitStatus::kFailed,
          Problem{"farm", endpoint_,
                  has_answered_          ? "it answers no longer"
                  : needs_key(endpoint_) ? "somebody listens there, but doesn't answer to this key"
                                         : "nobody answers; start one with 'graycube up'"}};
}

}  // namespace graycube
