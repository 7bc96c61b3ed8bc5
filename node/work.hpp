// What a node's brain hands to its evaluators, and what it gets back. Running a piece of work is
// pure: it touches nothing of the brain.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "topology/rank.hpp"
#include "trace/step.hpp"
#include "transport/message.hpp"

namespace graycube {

/// The inner boundaries of the grid of macro-regions, as pixel edges.
struct GridEdges {
  std::vector<std::int64_t> columns, rows;
};

/// Subdivide the macro-regions that came with `load`.
struct BuildWork {
  SharedBytes slice;
  /// The slice ends with so many bytes of light horizons.
  std::size_t horizon_bytes = 0;
  /// The model is the whole scene.
  bool is_replica = false;
  SubdivisionChoice subdivision;
  /// Nothing in `roth`: all of space.
  std::optional<GridEdges> edges;
  RegionShare share;
};
/// Subdivide another node's macro-regions, to finish shadow rays in them.
struct BorrowWork {
  Rank from;
  SharedBytes slice;
};
/// Subdivide a copy of a neighbour's macro-regions, to help it.
struct CopyWork {
  Rank from;
  RegionShare share;
  SharedBytes slice;
  /// Bytes of the light horizons at the slice's end, as in BuildWork; they are the node's own, too.
  std::size_t horizon_bytes = 0;
};
/// Get ready for the next generation of the grid, to which boundaries slide.
struct SlideWork {
  std::uint32_t generation = 0;
  GridEdges edges;
  RegionShare share;
  /// Empty if the part of the scene is that of the domain that the work comes with.
  SharedBytes slice;
};
/// Trace the primary rays of a tile, or of a part of it.
struct TileWork {
  PixelRect rect;
  std::uint32_t tile = 0;
};
/// Trace rays received from neighbours.
struct RayWork {
  std::vector<RayTask> rays;
};

struct Work {
  std::uint32_t job = 0, epoch = 0;
  /// TileWork, RayWork: traced for this neighbour, in the copy of its regions.
  std::optional<Rank> helped;
  std::shared_ptr<const Domain> domain;
  /// RayWork: a ray that a full node traces on its class's credit.
  std::optional<std::uint16_t> on_class;
  /// TileWork, RayWork: once so many rays have left, the rest is set aside.
  std::size_t most_leaving = std::numeric_limits<std::size_t>::max();
  /// RayWork, where boundaries slide: the domains of the generations in use, by
  /// RayTask::generation. Otherwise null, and `domain` is that of all rays.
  std::array<std::shared_ptr<const Domain>, kMostGenerations> generations;
  std::variant<BuildWork, BorrowWork, CopyWork, SlideWork, TileWork, RayWork> what;
};

/// The node's own macro-regions, subdivided; or why they could not be.
struct Built {
  std::shared_ptr<const Domain> domain;
  std::string error;
};
/// Another node's macro-regions, subdivided, for shadow rays; or why they could not be.
struct Borrowed {
  Rank from;
  std::shared_ptr<const Territory> model;
  std::string error;
};
/// A copy of a neighbour's macro-regions, subdivided, to help it; or why they could not be.
struct Copied {
  Rank from;
  std::shared_ptr<const Domain> domain;
  std::string error;
};
/// The node's macro-regions in the next generation, subdivided; or why they could not be.
struct SlidTo {
  std::uint32_t generation = 0;
  std::shared_ptr<const Domain> domain;
  std::string error;
};
/// The results of tracing a tile or rays.
struct Traced {
  /// `helped` and `on_class` are those of the Work.
  std::optional<Rank> helped;
  std::optional<std::uint16_t> on_class;
  /// TileWork: the tile.
  std::optional<std::uint32_t> tile;
  Step step;
  /// The cells visited and primitives tested in tracing it.
  WalkCounts walk;
};

struct WorkResult {
  std::uint32_t job = 0, epoch = 0;
  /// Seconds that building took; whoever ran the work has a clock and fills it in.
  double build_s = 0;
  std::variant<Built, Borrowed, Copied, SlidTo, Traced> what;
};

/// An evaluator thread's own memory: it keeps evaluators from one piece of work to the next.
class Workbench {
 public:
  /// Does the work. Never throws; a broken slice is an error in the result.
  WorkResult run(Work work);
  /// Frees the memory that it keeps of the last job.
  void clear();

 private:
  struct Place {
    std::shared_ptr<const Domain> domain;
    std::unique_ptr<Evaluator> evaluator;
  };
  Evaluator& evaluator_for(std::shared_ptr<const Domain> domain);
  Evaluator& evaluator_for(const Work& work, std::uint32_t generation);
  Traced trace(Work& work, const PixelRect* pixels, std::span<const RayTask> rays);

  /// The node's own regions and a copy of a neighbour's, or those of two generations of the grid;
  /// the last used first.
  std::array<Place, 2> places_;
};

}  // namespace graycube
