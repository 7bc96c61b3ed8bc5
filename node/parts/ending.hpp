// How a node passes on the token that detects the picture's end (coordination/termination.hpp):
// when, to whom, and what rank 0 tells the frontal of it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "coordination/termination.hpp"
#include "node/parts/mail.hpp"
#include "node/parts/seat.hpp"

namespace graycube {

class Ending {
 public:
  /// `never_rests`: rounds begin without waiting for what hints at the end, as in 1987.
  Ending(const Seat& seat, bool never_rests);

  /// Rays, tiles or light came from a neighbour.
  void work_came() { token_.message_received(); }
  /// Tiles of this node were traced by others.
  void work_was_taken() { token_.work_was_taken(); }
  /// The frontal tells rank 0 that all tiles are whole: no ray is left anywhere.
  void all_are_whole() { all_are_whole_ = true; }
  /// False when the token was of no use.
  [[nodiscard]] bool on_token(std::span<const std::byte> batch, const BatchLimits& limits,
                              Mail& mail);
  /// Passes the token on if it is here and may go. `is_passive`: nothing is under way on this node.
  /// `ping`: the number of the frontal's ping that is being answered.
  void pass(bool is_passive, std::optional<std::uint64_t> ping, Mail& mail);
  /// A new epoch.
  void reset();

 private:
  bool may_launch(std::optional<std::uint64_t> ping) const;
  void tell_round(const Token& token, Mail& mail) const;
  void tell_verdict(Mail& mail) const;

  /// The link to the next node on the ring; nothing on a ring of one.
  std::optional<std::uint32_t> next_bit_;
  bool never_rests_;
  bool is_initiator_;
  TerminationRing token_;
  bool all_are_whole_ = false;
};

}  // namespace graycube
