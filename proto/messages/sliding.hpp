// Control messages with which boundaries between macro-regions slide while a picture is rendered
// (docs/design/sliding.md). A generation is a grid of macro-regions: 0 came with `load`, and each
// slide begins the next.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace graycube::control {

/// To a node: hold this generation of the grid, too. A binary frame follows: the node's slice of
/// it; none if the node's part of the scene is the same as in the generation before.
struct Slide {
  static constexpr std::string_view kType = "slide";
  std::uint32_t job = 0, epoch = 0, generation = 1;
  /// Inner boundaries as pixel edges, as many as in GridLayout.
  std::vector<std::int64_t> column_edges{}, row_edges{};
  friend bool operator==(const Slide&, const Slide&) = default;
};

/// To the frontal: the node holds the generation, and rays of it may come.
struct Slid {
  static constexpr std::string_view kType = "slid";
  std::uint32_t job = 0, epoch = 0, generation = 1;
  /// Seconds that decoding and subdividing the slice took.
  double build_s = 0;
  friend bool operator==(const Slid&, const Slid&) = default;
};

/// To a node: tiles that are assigned from here on belong to generation `current`; no ray is left
/// of generations before `oldest`.
struct Turn {
  static constexpr std::string_view kType = "turn";
  std::uint32_t job = 0, epoch = 0, current = 0, oldest = 0;
  friend bool operator==(const Turn&, const Turn&) = default;
};

/// To a node: all tiles have been handed out, so that none will come any more.
struct Dealt {
  static constexpr std::string_view kType = "dealt";
  std::uint32_t job = 0, epoch = 0;
  friend bool operator==(const Dealt&, const Dealt&) = default;
};

/// To the frontal: what the node has done in the picture so far.
struct Worked {
  static constexpr std::string_view kType = "worked";
  std::uint32_t job = 0, epoch = 0;
  /// In tests of a primitive, by the measure of trace/work_cost.hpp.
  std::uint64_t work = 0;
  /// Tiles whose primary rays were traced here.
  std::uint32_t tiles = 0;
  friend bool operator==(const Worked&, const Worked&) = default;
};

}  // namespace graycube::control
