// How the flow of rays wants work to be handed out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace graycube {

/// The most received rays that are handed to an evaluator in one piece.
inline constexpr std::size_t kMaxRaysPerWork = 256;
/// A piece of work sets its rest aside once so many rays have left it: this part, one in so many,
/// of what the outboxes may hold.
inline constexpr std::uint64_t kWorksPerOutboxes = 16;

struct Pace {
  std::size_t most_rays = kMaxRaysPerWork;
  /// Rays that may leave in a piece of work before the rest of it is set aside.
  std::size_t most_leaving = std::numeric_limits<std::size_t>::max();
  /// Whether primary rays are handed out pixel by pixel, and received rays first come first served;
  /// otherwise tile by tile and deepest first.
  bool is_one_by_one = false;
  /// The token goes round all the time, whether or not anything hints at the end.
  bool token_never_rests = false;
};

}  // namespace graycube
