// The reference: the whole picture in this process, without a socket.
#pragma once

#include <functional>

#include "film/film.hpp"
#include "trace/step.hpp"

namespace graycube {

struct SerialOptions {
  unsigned threads = 1;
  /// Called now and then, from one thread at a time, with the share of the tiles done; false
  /// cancels.
  std::function<bool(double)> progress{};
  /// Whether the film is without a tile's light yet; the others are passed over.
  std::function<bool(const PixelRect&)> is_wanted{};
  /// Called by whichever thread has traced a tile, once the film holds it.
  std::function<void(const PixelRect&)> tile_done{};
};

struct SerialResult {
  /// False when progress() cancelled: the film is incomplete.
  bool finished = true;
  RayCounts rays;
  RoundingCounts rounding;
  WalkCounts walk;
  /// CPU seconds inside the pure step, all threads together.
  double busy_s = 0;
};

/// Renders into `film`, whose size must be the domain's picture's.
SerialResult render_serial(const Domain& domain, const SerialOptions& options, Film& film);

}  // namespace graycube
