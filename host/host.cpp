#include "host/host.hpp"

#include <algorithm>

#include "overloaded.hpp"

namespace graycube {
namespace {

/// A host that has asked to join asks again after so many seconds, over a new connection: the
/// frontal may have been started since.
constexpr double kAskAgain_s = 5;
/// If it is longer than so many seconds since the last call, this process didn't run.
constexpr double kLongestTurn_s = 0.5;

std::string text_of(const control::Failed& m) {
  if (m.errors.empty()) return "it is refused";
  const control::ErrorItem& first = m.errors.front();
  return (first.where.empty() ? "" : first.where + ": ") + first.why;
}

}  // namespace

Host::Host(control::Join about, double now_s) : about_(std::move(about)), looks_since_s_(now_s) {
  last_time_s_ = now_s;
  ask(now_s);
}

void Host::ask(double now_s) {
  state_ = State::kJoining;
  asked_s_ = now_s;
  outgoing_.clear();
  outgoing_.emplace_back(about_);
}

/// Whoever can't reach the frontal can't end its nodes in order either.
void Host::drop_farm(double now_s) {
  kills_all_ = true;
  starts_.clear();
  kills_.clear();
  ping_.reset();
  looks_since_s_ = now_s;
  reconnects_ = true;
  ask(now_s);
}

void Host::on_message(const ControlMessage& message, double now_s) {
  if (state_ == State::kOver) return;
  last_heard_s_ = now_s;
  std::visit(Overloaded{
                 [&](const control::Joined& m) {
                   if (state_ != State::kJoining) return;
                   farm_ = m;
                   state_ = State::kJoined;
                 },
                 [&](const control::RunNodes& m) {
                   if (state_ != State::kJoined) return;
                   for (const control::NodeToRun& node : m.nodes)
                     starts_.push_back({Rank{node.rank}, node.incarnation});
                 },
                 [&](const control::EndNode& m) {
                   kills_.push_back({Rank{m.rank}, m.incarnation});
                 },
                 [&](const control::Ping& m) {
                   if (state_ == State::kJoined) ping_ = m.sequence;
                 },
                 [&](const control::Shutdown&) {
                   state_ = State::kEnding;
                   ends_since_s_ = now_s;
                 },
                 [&](const control::Failed& m) {
                   // A frontal that took this host for lost has given its nodes to others.
                   if (state_ == State::kJoined) return drop_farm(now_s);
                   if (state_ == State::kJoining) give_up(text_of(m));
                 },
                 [](const auto&) {},
             },
             message);
}

void Host::on_exit(const NodeExit& exit) {
  if (state_ != State::kJoined) return;
  outgoing_.emplace_back(
      control::NodeEnded{exit.node.rank.value, exit.node.incarnation, exit.how, exit.was_started});
}

void Host::on_time(double now_s, bool has_nodes) {
  // What came while this process didn't run lies unread: that is no silence of the frontal's.
  const double passed_s = now_s - std::exchange(last_time_s_, now_s);
  if (passed_s > kLongestTurn_s) last_heard_s_ += passed_s;
  if (state_ == State::kJoined &&
      now_s - last_heard_s_ > static_cast<double>(farm_->silence_ms) / 1000) {
    return drop_farm(now_s);
  }
  if (state_ == State::kJoining) {
    if (now_s - looks_since_s_ > (farm_ ? kRejoin_s : kFirstJoin_s)) {
      return give_up(farm_ ? "the frontal fell silent, and isn't back" : "nobody answers");
    }
    if (now_s - asked_s_ > kAskAgain_s) {
      reconnects_ = true;
      ask(now_s);
    }
  }
  if (state_ != State::kEnding) return;
  if (has_nodes && now_s - ends_since_s_ > kHostGrace_s) kills_all_ = true;
  if (!has_nodes) state_ = State::kOver;
}

void Host::leave(double now_s) {
  if (state_ == State::kJoining) {
    state_ = State::kOver;
    return;
  }
  if (state_ != State::kJoined) return;
  outgoing_.emplace_back(control::Leave{});
  kills_all_ = true;
  state_ = State::kEnding;
  ends_since_s_ = now_s;
}

void Host::give_up(std::string why) {
  failure_ = std::move(why);
  kills_all_ = true;
  state_ = State::kOver;
}

void Host::answer_ping(std::uint64_t sequence, std::vector<std::uint32_t> stopped) {
  outgoing_.emplace_back(control::Alive{sequence, std::move(stopped)});
}

}  // namespace graycube
