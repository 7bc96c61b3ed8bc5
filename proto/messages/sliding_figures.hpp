// What sliding boundaries took in a picture, for the statistics file.
#pragma once

#include <cstdint>

namespace graycube {

struct SlidingFigures {
  /// How often boundaries slid, and how many of them did, each counted as often as it slid.
  std::uint64_t slides = 0, boundaries = 0;
  /// Slices that were cut anew and sent, their bytes and primitives, and those primitives that the
  /// node did not hold before.
  std::uint64_t slices = 0, slice_bytes = 0, primitives = 0, new_primitives = 0;
  /// Seconds of cutting in the frontal, of subdividing in all nodes together, and from when a slide
  /// was decided until tiles were handed out by it.
  double recut_s = 0, build_s = 0, slide_s = 0;
  /// The most generations of the grid in use at a time.
  std::uint32_t generations_peak = 1;
};

}  // namespace graycube
