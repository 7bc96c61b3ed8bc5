#include "node/parts/ending.hpp"

#include <string>

#include "check.hpp"

namespace graycube {
namespace {

/// A batch may be slow while the token goes round quickly, so after so many white rounds with the
/// same non-zero sum each further one waits for the frontal's next ping.
constexpr std::uint32_t kFreeStalledRounds = 1;
/// After so many such rounds a batch is taken to be lost here.
constexpr std::uint32_t kRoundsUntilLossHere = 32;
/// So many rounds need wait for nothing. Once all tiles are whole two more are enough, and until
/// then rounds mostly find rays under way. So further rounds wait for all tiles to be whole, or (as
/// a batch may be lost) for every kPingsToARound-th ping.
constexpr std::uint32_t kFreeRounds = 2;
constexpr std::uint64_t kPingsToARound = 8;

}  // namespace

Ending::Ending(const Seat& seat, bool never_rests)
    : never_rests_(never_rests),
      is_initiator_(seat.rank.value == 0),
      token_(is_initiator_ ? TerminationRing::Role::kInitiator : TerminationRing::Role::kMember,
             kRoundsUntilLossHere) {
  const Rank next = seat.cube.ring_next(seat.rank);
  if (next != seat.rank) next_bit_ = seat.bit_of(next);
}

void Ending::reset() {
  token_.reset();
  all_are_whole_ = false;
}

bool Ending::on_token(std::span<const std::byte> batch, const BatchLimits& limits, Mail& mail) {
  Token token;
  const auto result = decode_token(batch, limits, token);
  const bool is_broken = std::holds_alternative<BatchError>(result);
  if (is_broken || !token_.token_arrived(token)) {
    mail.drop("token", is_broken ? "malformed" : "none was due");
    return false;
  }
  if (is_initiator_) tell_round(token, mail);
  return true;
}

bool Ending::may_launch(std::optional<std::uint64_t> ping) const {
  if (token_.stalled_rounds() > kFreeStalledRounds) return ping.has_value();
  return never_rests_ || all_are_whole_ || token_.rounds_launched() < kFreeRounds ||
         (ping && *ping % kPingsToARound == 0);
}

void Ending::pass(bool is_passive, std::optional<std::uint64_t> ping, Mail& mail) {
  const Mail::Counted counted = mail.take_counted();
  token_.message_sent(counted.work);
  token_.contribution_batch_sent(counted.light);
  const bool had_verdict = token_.verdict().has_value();
  while (const auto token = token_.try_pass(is_passive, may_launch(ping))) {
    if (next_bit_) {
      mail.to_neighbour(*next_bit_,
                        [&](const BatchStamp& stamp) { return encode_token(stamp, *token); });
    } else {
      GRAYCUBE_CHECK(token_.token_arrived(*token), "a ring of one lost its token");
      tell_round(*token, mail);
    }
  }
  if (!had_verdict && token_.verdict()) tell_verdict(mail);
}

void Ending::tell_round(const Token& token, Mail& mail) const {
  mail.to_frontal(control::TokenRound{mail.job(), mail.epoch(), token.round, token.hops,
                                      token.black, token.count});
}

void Ending::tell_verdict(Mail& mail) const {
  const Verdict& v = *token_.verdict();
  if (v.outcome == Verdict::Outcome::kLost) {
    return mail.fail(std::to_string(v.missing) +
                     " batches of rays were sent by nodes but never received by any");
  }
  mail.to_frontal(
      control::Terminated{mail.job(), mail.epoch(), v.rounds, v.hops, v.contribution_batches});
}

}  // namespace graycube
