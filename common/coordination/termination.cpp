#include "coordination/termination.hpp"

#include <utility>

#include "check.hpp"

namespace graycube {

namespace {

/// A sum that wraps: a token's count comes off the wire and may be anything.
std::int64_t plus(std::int64_t a, std::uint64_t b) {
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(a) + b);
}

}  // namespace

TerminationRing::TerminationRing(Role role, std::uint32_t rounds_until_loss)
    : role_(role), rounds_until_loss_(rounds_until_loss) {
  GRAYCUBE_CHECK(rounds_until_loss >= 1, "%u rounds", rounds_until_loss);
}

void TerminationRing::message_sent(std::uint64_t messages) { count_ = plus(count_, messages); }

void TerminationRing::message_received(std::uint64_t messages) {
  if (messages == 0) return;
  count_ = plus(count_, 0 - messages);
  black_ = true;
}

void TerminationRing::contribution_batch_sent(std::uint64_t batches) {
  contribution_batches_ += batches;
}

bool TerminationRing::token_arrived(const Token& token) {
  if (held_ || verdict_) return false;
  const bool due = role_ == Role::kInitiator ? last_round_ > 0 && token.round == last_round_
                                             : token.round > last_round_;
  if (due) held_ = token;
  return due;
}

std::optional<Token> TerminationRing::try_pass(bool passive, bool may_launch) {
  if (!passive || verdict_) return std::nullopt;
  if (role_ == Role::kMember) {
    if (!held_) return std::nullopt;
    const Token token = *held_;
    held_.reset();
    return pass_on(token);
  }
  if (held_) {
    judge(*held_);
    judged_ = std::exchange(held_, std::nullopt);
  }
  if (verdict_ || !may_launch) return std::nullopt;
  if (last_round_ == 0) return launch(1, 0);
  if (!judged_) return std::nullopt;
  const Token returned = *std::exchange(judged_, std::nullopt);
  return launch(returned.round + 1, returned.hops);
}

Token TerminationRing::pass_on(Token token) {
  token.black = token.black || black_;
  token.count = plus(token.count, static_cast<std::uint64_t>(count_));
  token.contribution_batches += contribution_batches_;
  ++token.hops;
  black_ = false;
  last_round_ = token.round;
  return token;
}

Token TerminationRing::launch(std::uint32_t round, std::uint32_t hops) {
  // The initiator's own counts are added when the token comes back, not now.
  black_ = false;
  last_round_ = round;
  return {.round = round, .hops = hops + 1};
}

void TerminationRing::judge(const Token& returned) {
  const std::int64_t sum = plus(returned.count, static_cast<std::uint64_t>(count_));
  const bool white = !returned.black && !black_;
  Verdict verdict{.rounds = returned.round, .hops = returned.hops};
  if (white && sum == 0) {
    verdict.contribution_batches = returned.contribution_batches + contribution_batches_;
    verdict_ = verdict;
    return;
  }
  if (!white) {
    stalled_rounds_ = 0;
    return;
  }
  stalled_rounds_ = stalled_rounds_ > 0 && sum == stalled_sum_ ? stalled_rounds_ + 1 : 1;
  stalled_sum_ = sum;
  if (stalled_rounds_ < rounds_until_loss_) return;
  verdict.outcome = Verdict::Outcome::kLost;
  verdict.missing = sum;
  verdict_ = verdict;
}

void TerminationRing::reset() { *this = TerminationRing(role_, rounds_until_loss_); }

}  // namespace graycube
