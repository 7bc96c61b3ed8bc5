// Detects when nothing is left to do anywhere: the coloured token of Dijkstra, Feijen and van
// Gasteren (1983) on the ring of nodes, with Safra's message count (Dijkstra, EWD 998). The 1983
// rules alone assume that messages take no time; over asynchronous links they detect too early
// (tests/model/token.pml shows how). Each node has one TerminationRing, which knows nothing of
// links, clocks or epochs: the caller stamps tokens with job and epoch, drops those of another, and
// resets the ring when an epoch begins.
#pragma once

#include <cstdint>
#include <optional>

namespace graycube {

/// The token that goes round the ring.
struct Token {
  /// Whether some node that it has passed received a message since the token's last visit.
  bool black = false;
  /// Messages sent less messages received, over the nodes passed.
  std::int64_t count = 0;
  /// The number of rounds of the ring, this one included.
  std::uint32_t round = 0;
  /// The number of times that it was handed on, over all rounds.
  std::uint32_t hops = 0;
  /// Contribution batches sent to the frontal, over the nodes passed.
  std::uint64_t contribution_batches = 0;

  friend bool operator==(const Token&, const Token&) = default;
};

/// The conclusion that rank 0 has drawn from the token.
struct Verdict {
  enum class Outcome : std::uint8_t {
    kQuiet,  ///< every node is passive and no message is under way
    kLost,   ///< messages were sent and, so it seems, never arrived
  };
  Outcome outcome = Outcome::kQuiet;
  std::uint32_t rounds = 0;
  std::uint32_t hops = 0;
  /// For kQuiet: the number of batches that the frontal must hold in the end.
  std::uint64_t contribution_batches = 0;
  /// For kLost: the number of messages sent but not received; if negative, received twice.
  std::int64_t missing = 0;

  friend bool operator==(const Verdict&, const Verdict&) = default;
};

/// This many white rounds in a row with the same non-zero sum are taken for a loss. A message that
/// is merely slower than the token going round twice looks the same; acting on it then costs an
/// epoch, not the picture. A caller whose links may be that slow waits before each try_pass while
/// stalled_rounds() > 0.
inline constexpr std::uint32_t kRoundsUntilLoss = 2;

class TerminationRing {
 public:
  enum class Role : std::uint8_t { kMember, kInitiator };

  /// The initiator is rank 0. rounds_until_loss ≥ 1.
  explicit TerminationRing(Role role, std::uint32_t rounds_until_loss = kRoundsUntilLoss);

  /// Messages are whatever can make a passive node active again: ray batches, not tokens, grants or
  /// contributions. Sent when handed to the link (or to its outbox), received when taken from it.
  void message_sent(std::uint64_t messages = 1);
  void message_received(std::uint64_t messages = 1);
  /// Call this when another node has done work of this node: what the token has learnt from the
  /// nodes before this one may be out of date.
  void work_was_taken() { black_ = true; }
  void contribution_batch_sent(std::uint64_t batches = 1);

  /// Takes the token from the ring. False, and nothing changes, when no token can be due: a
  /// duplicate, or one of a round that is over.
  [[nodiscard]] bool token_arrived(const Token& token);

  /// The token to hand to the next node on the ring (on a ring of one, to this node), if it is here
  /// and may go. `passive`: no primary ray left, no received ray, no evaluator at work, no ray in
  /// an outbox, no contribution unsent. The initiator launches the first token as soon as it is
  /// passive, so rounds count from its last primary ray; it judges each token that has come back,
  /// and then either has a verdict or launches the next round, at once or when it may.
  std::optional<Token> try_pass(bool passive, bool may_launch = true);

  /// The initiator's verdict; none on other nodes. From it on no token goes out until reset().
  const std::optional<Verdict>& verdict() const { return verdict_; }
  bool holds_token() const { return held_.has_value(); }
  /// The number of rounds that the initiator has launched so far; 0 on other nodes.
  std::uint32_t rounds_launched() const { return role_ == Role::kInitiator ? last_round_ : 0; }
  /// The number of the initiator's latest white rounds in a row with the same non-zero sum.
  std::uint32_t stalled_rounds() const { return stalled_rounds_; }

  /// Begins a new epoch: forgets token, colour, counts and verdict.
  void reset();

 private:
  void judge(const Token& returned);
  Token launch(std::uint32_t round, std::uint32_t hops);
  Token pass_on(Token token);

  Role role_;
  std::uint32_t rounds_until_loss_;
  bool black_ = false;
  std::int64_t count_ = 0;
  std::uint64_t contribution_batches_ = 0;
  std::uint32_t last_round_ = 0;  // launched by the initiator, passed on by the others
  std::optional<Token> held_;
  /// The initiator's token that came back and gave no verdict, so that another round is due.
  std::optional<Token> judged_;
  std::optional<Verdict> verdict_;
  std::uint32_t stalled_rounds_ = 0;
  std::int64_t stalled_sum_ = 0;
};

}  // namespace graycube
