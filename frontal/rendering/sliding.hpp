// Boundaries that slide while a picture is rendered (docs/design/sliding.md): when they do, which
// generation of the grid each tile belongs to, and what sliding takes.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "frontal/preparation/preparation.hpp"
#include "frontal/preparation/recut.hpp"
#include "frontal/rendering/roll_call.hpp"
#include "frontal/rendering/sliding_limits.hpp"
#include "proto/messages.hpp"
#include "proto/messages/sliding_figures.hpp"
#include "trace/ray_task.hpp"
#include "trace/tile_lines.hpp"
#include "trace/tile_plan.hpp"

namespace graycube {

class Sliding {
 public:
  /// Generation 0 is the scene's grid, whose boundaries must be lines between tiles. The scene must
  /// outlive this.
  Sliding(std::uint32_t job, const Hypercube& cube, const PreparedScene& scene,
          std::uint32_t threads, const SlidingLimits& limits);

  // Tiles
  /// Whose macro-region each tile is in, by its number.
  const std::vector<Rank>& owners() const { return owners_; }
  void was_handed_out(std::uint32_t tile, Rank to);
  void is_whole(std::uint32_t tile);
  /// The tile was whole before: it won't be handed out.
  void was_whole(std::uint32_t tile);
  void has_worked(Rank rank, const control::Worked& m);
  /// How many tiles the node may be given now, of `left` that are its own: it has yet to begin so
  /// few of the last that it is worth a message.
  std::uint32_t room_ahead(Rank rank, std::size_t left) const;
  bool all_handed_out() const { return left_ == 0; }

  // A slide, step by step
  /// Decides whether boundaries are to slide now.
  void look(double now_s);
  /// What is to be cut for the slide that was decided.
  std::optional<RecutWork> take_recut();
  /// The slices are cut: what all nodes are to be told. False if that came too late.
  [[nodiscard]] bool was_recut(const RecutResult& cut);
  control::Slide slide_message(std::uint32_t epoch) const;
  /// A node holds the next generation. True if now all do, and it begins: tiles that are left have
  /// new owners.
  [[nodiscard]] bool is_held(Rank rank, const control::Slid& m, double now_s);
  /// True once, when no tile of an older generation is open any more.
  [[nodiscard]] bool take_closed();
  std::uint32_t generation() const { return generation_; }
  std::uint32_t oldest() const { return oldest_; }

  const SlidingFigures& figures() const { return figures_; }

 private:
  enum class Stage : std::uint8_t { kResting, kDecided, kCutting, kBuilding };
  struct NodeWork {
    double work = 0;
    std::uint32_t begun = 0, handed_out = 0;
  };

  /// Tiles that the node was given and has not begun, as far as it has told.
  std::uint32_t ahead(Rank rank) const;
  RegionIndex region_of(Rank rank) const;
  std::vector<double> costs() const;
  WorkLeft work_left() const;
  void set_owners(const MacroGrid& grid);
  void begin_next(double now_s);

  std::uint32_t job_;
  Hypercube cube_;
  const TilePlan& plan_;
  std::shared_ptr<const Model> model_;
  CameraFrame frame_;
  std::uint32_t threads_;
  SlidingLimits limits_;
  TileLines lines_;
  RectilinearCuts cuts_;
  MacroGrid grid_;
  /// The grid to which boundaries slide, from when that is decided.
  std::optional<MacroGrid> next_;
  Stage stage_ = Stage::kResting;
  RollCall held_by_;
  std::uint32_t generation_ = 0, oldest_ = 0;

  std::vector<Rank> owners_;  // by tile
  /// By tile: the cost for each tile of the owner that lost it, in tests; 0 if none has.
  std::vector<double> cost_before_;
  std::vector<bool> is_handed_out_;
  /// By tile, if handed out: the lowest bit of its generation.
  std::vector<bool> parity_;
  std::array<std::uint32_t, kMostGenerations> open_{};  // by parity
  std::uint32_t left_, whole_ = 0, whole_at_last_look_ = 0;
  std::vector<NodeWork> nodes_;  // by rank
  double decided_at_s_ = 0;
  SlidingFigures figures_;
};

}  // namespace graycube
