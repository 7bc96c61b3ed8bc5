#include "frontal/rendering/sliding.hpp"

#include <algorithm>
#include <utility>

#include "check.hpp"

namespace graycube {
namespace {

std::vector<std::int64_t> edges_at(const std::vector<std::uint32_t>& cuts,
                                   const std::vector<std::int64_t>& lines) {
  std::vector<std::int64_t> edges;
  for (const std::uint32_t cut : cuts) edges.push_back(lines[cut]);
  return edges;
}

std::uint64_t differences(const std::vector<std::int64_t>& a, const std::vector<std::int64_t>& b) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < a.size(); ++i) count += a[i] != b[i];
  return count;
}

RectilinearCuts cuts_in(const TileLines& lines, const MacroGrid& grid) {
  auto cuts = lines.cuts_of(grid);
  GRAYCUBE_CHECK(cuts.has_value(), "boundaries that slide must lie between tiles");
  return *std::move(cuts);
}

}  // namespace

Sliding::Sliding(std::uint32_t job, const Hypercube& cube, const PreparedScene& scene,
                 std::uint32_t threads, const SlidingLimits& limits)
    : job_(job),
      cube_(cube),
      plan_(*scene.plan),
      model_(scene.model),
      frame_(CameraFrame::from(scene.settings.camera, scene.settings.image)),
      threads_(threads),
      limits_(limits),
      lines_(TileLines::of(plan_)),
      grid_(frame_, scene.grid.column_edges, scene.grid.row_edges),
      held_by_(cube.nodes()),
      owners_(plan_.tile_count()),
      cost_before_(plan_.tile_count(), 0),
      is_handed_out_(plan_.tile_count(), false),
      parity_(plan_.tile_count(), false),
      left_(plan_.tile_count()),
      nodes_(cube.nodes()) {
  cuts_ = cuts_in(lines_, grid_);
  set_owners(grid_);
}

RegionIndex Sliding::region_of(Rank rank) const {
  const NodeMesh::Place place = NodeMesh(cube_).place_of(rank);
  return {static_cast<std::uint16_t>(place.column), static_cast<std::uint16_t>(place.row)};
}

void Sliding::set_owners(const MacroGrid& grid) {
  const NodeMesh mesh(cube_);
  for (std::uint32_t tile = 0; tile < owners_.size(); ++tile) {
    const PixelRect rect = plan_.rect(tile);
    const RegionIndex region = grid.region_of_pixel(rect.x0, rect.y0);
    owners_[tile] = mesh.owner_of(region.column, region.row);
  }
}

// ---- tiles

void Sliding::was_handed_out(std::uint32_t tile, Rank to) {
  is_handed_out_[tile] = true;
  parity_[tile] = generation_ % kMostGenerations != 0;
  ++open_[generation_ % kMostGenerations];
  ++nodes_[to.value].handed_out;
  --left_;
}

void Sliding::is_whole(std::uint32_t tile) {
  if (!is_handed_out_[tile]) return;
  --open_[parity_[tile]];
  ++whole_;
}

void Sliding::was_whole(std::uint32_t tile) {
  is_handed_out_[tile] = true;
  --left_;
  ++whole_;
}

void Sliding::has_worked(Rank rank, const control::Worked& m) {
  NodeWork& node = nodes_[rank.value];
  node.work = static_cast<double>(m.work);
  node.begun = std::min(m.tiles, node.handed_out);
}

std::uint32_t Sliding::ahead(Rank rank) const {
  return nodes_[rank.value].handed_out - nodes_[rank.value].begun;
}

std::uint32_t Sliding::room_ahead(Rank rank, std::size_t left) const {
  const auto most =
      std::max(limits_.least_ahead * threads_,
               static_cast<std::uint32_t>(limits_.most_ahead * static_cast<double>(left)));
  const std::uint32_t taken = ahead(rank);
  return 2 * taken <= most ? most - taken : 0;
}

// ---- what is left

/// The work that a tile takes each node, by rank, as far as its work so far tells: rays that come
/// from others count for the tiles of the region that they come to.
std::vector<double> Sliding::costs() const {
  double work = 0;
  std::uint64_t begun = 0;
  for (const NodeWork& node : nodes_) {
    work += node.work;
    begun += node.begun;
  }
  const double mean = work / static_cast<double>(std::max<std::uint64_t>(1, begun));
  std::vector<double> costs;
  for (const NodeWork& node : nodes_) {
    const double own = node.work / std::max(1u, node.begun);
    costs.push_back(node.begun > 0 ? own : std::max(own, mean));
  }
  return costs;
}

WorkLeft Sliding::work_left() const {
  const std::vector<double> cost = costs();
  WorkLeft left{LoadMap(static_cast<std::uint32_t>(lines_.columns.size()),
                        static_cast<std::uint32_t>(lines_.rows.size())),
                LoadMap(cube_.columns(), cube_.rows())};
  for (std::uint32_t tile = 0; tile < owners_.size(); ++tile) {
    if (is_handed_out_[tile]) continue;
    const PixelRect rect = plan_.rect(tile);
    left.cells.at(lines_.column_of(rect.x0), lines_.row_of(rect.y0)) =
        cost_before_[tile] > 0 ? cost_before_[tile] : cost[owners_[tile].value];
  }
  for (std::uint32_t rank = 0; rank < nodes_.size(); ++rank) {
    const RegionIndex region = region_of(Rank{rank});
    left.parts.at(region.column, region.row) = ahead(Rank{rank}) * cost[rank];
  }
  return left;
}

// ---- a slide

void Sliding::look(double now_s) {
  const double between = limits_.part_between * static_cast<double>(owners_.size());
  const bool is_free = stage_ == Stage::kResting && oldest_ == generation_ && !all_handed_out();
  if (!is_free || whole_ - whole_at_last_look_ < between) return;
  whole_at_last_look_ = whole_;
  const RectilinearCuts cuts = slid_cuts(work_left(), cuts_, limits_.rules);
  if (cuts == cuts_) return;
  next_.emplace(frame_, edges_at(cuts.columns, lines_.columns), edges_at(cuts.rows, lines_.rows));
  stage_ = Stage::kDecided;
  decided_at_s_ = now_s;
}

std::optional<RecutWork> Sliding::take_recut() {
  if (stage_ != Stage::kDecided) return std::nullopt;
  stage_ = Stage::kCutting;
  return RecutWork{job_, generation_ + 1, model_, cube_, grid_, *next_};
}

bool Sliding::was_recut(const RecutResult& cut) {
  if (stage_ != Stage::kCutting || cut.generation != generation_ + 1) return false;
  stage_ = Stage::kBuilding;
  figures_.recut_s += cut.seconds;
  if (all_handed_out()) return false;
  held_by_ = RollCall(cube_.nodes());
  for (const SharedBytes& slice : cut.slices) figures_.slices += !slice.empty();
  figures_.slice_bytes += cut.bytes;
  figures_.primitives += cut.primitives;
  figures_.new_primitives += cut.new_primitives;
  figures_.generations_peak = kMostGenerations;
  return true;
}

control::Slide Sliding::slide_message(std::uint32_t epoch) const {
  return {job_, epoch, generation_ + 1, next_->column_edges(), next_->row_edges()};
}

bool Sliding::is_held(Rank rank, const control::Slid& m, double now_s) {
  if (stage_ != Stage::kBuilding || m.generation != generation_ + 1 || !held_by_.note(rank))
    return false;
  figures_.build_s += m.build_s;
  if (!held_by_.is_complete() || all_handed_out()) return false;
  begin_next(now_s);
  return true;
}

/// Tiles that change hands keep what they cost where they were: elsewhere others may cost less.
void Sliding::begin_next(double now_s) {
  const std::vector<double> cost = costs();
  const std::vector<Rank> before = owners_;
  set_owners(*next_);
  for (std::uint32_t tile = 0; tile < owners_.size(); ++tile) {
    const bool is_lost = !is_handed_out_[tile] && owners_[tile] != before[tile];
    if (is_lost && cost_before_[tile] == 0) cost_before_[tile] = cost[before[tile].value];
  }
  figures_.boundaries += differences(grid_.column_edges(), next_->column_edges()) +
                         differences(grid_.row_edges(), next_->row_edges());
  ++figures_.slides;
  figures_.slide_s += now_s - decided_at_s_;
  grid_ = *std::exchange(next_, std::nullopt);
  cuts_ = cuts_in(lines_, grid_);
  oldest_ = generation_++;
  stage_ = Stage::kResting;
}

bool Sliding::take_closed() {
  if (oldest_ == generation_ || open_[oldest_ % kMostGenerations] != 0) return false;
  oldest_ = generation_;
  return true;
}

}  // namespace graycube
