// How the flow of rays wants work to be handed out.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace graycube {

/// Received rays handed to an evaluator in one piece.
inline constexpr std::size_t kMaxRaysPerWork = 256;
/// Once this part of what the outboxes may hold has left in a piece of work, the rest of it is set
/// aside.
inline constexpr std::uint64_t kWorksPerOutboxes = 16;

struct Pace {
  std::size_t most_rays = kMaxRaysPerWork;
  /// Of a piece of work: then the rest of it is set aside.
  std::size_t most_leaving = std::numeric_limits<std::size_t>::max();
  /// Primary rays are handed out pixel by pixel, and received rays as they came; otherwise tile by
  /// tile and deepest first.
  bool is_one_by_one = false;
  /// The token goes round all the time, whatever hints there are at the end.
  bool token_never_rests = false;
};

}  // namespace graycube
