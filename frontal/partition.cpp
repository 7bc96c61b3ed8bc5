#include "frontal/partition.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "space/rectilinear.hpp"
#include "trace/coarse_load.hpp"

namespace graycube {
namespace {

/// Cells of the coarse pre-render along each side of a macro-region, and along each side of the grid at most: fewer where each
/// is traced by itself. (With 16 nodes 4, 8 and 16 cells balance csg10k to 0.80, 0.88 and 0.87.)
constexpr std::uint32_t kFineCells = 8;
constexpr std::uint32_t kLeastFineCells = 2;
constexpr std::uint32_t kMostCells = 64, kMostCellsApart = 32;
/// What a ray that comes in costs a node, in primitives that it tests. Its evaluators hardly notice (what they do for
/// it counts by itself); its mailroom decodes and stores it.
constexpr double kCrossingCost = 3;
/// Enough to tell the work of a macro-region from that of the next, and what its shadow rays ask for.
constexpr std::uint32_t kCoarsePixelsPerNode = 512;
/// The pre-render subdivides the whole scene: where nothing is asked for, there must be this many primary rays to
/// each primitive.
constexpr std::uint64_t kPrimaryRaysPerPrimitive = 2;

/// In which part a fine cell is.
std::uint16_t cell_of(std::uint16_t fine, const std::vector<std::uint32_t>& cuts) {
  return static_cast<std::uint16_t>(std::upper_bound(cuts.begin(), cuts.end(), fine) - cuts.begin());
}

}  // namespace

Partition partition_of(const WholeScene& whole, const Hypercube& cube, std::uint32_t scatter, PartitionMode wanted,
                       const std::shared_ptr<const LightHorizons>& horizons, Staying staying) {
  const ImageSize& image = whole.model().settings.image;
  const auto frame = CameraFrame::from(whole.model().settings.camera, image);
  const std::uint32_t columns = cube.columns() * scatter, rows = cube.rows() * scatter;
  const std::uint32_t most = staying.all() ? kMostCells : kMostCellsApart;
  const std::uint32_t fine = std::clamp(most / std::max(columns, rows), kLeastFineCells, kFineCells);
  const bool too_small = image.width < columns * fine * 2 || image.height < rows * fine * 2;
  const bool too_costly = wanted == PartitionMode::kAuto && !whole.has_primary_rays(kPrimaryRaysPerPrimitive);
  if (wanted == PartitionMode::kRegular || cube.nodes() == 1 || too_small || too_costly) {
    return {PartitionMode::kRegular, MacroGrid::regular(frame, columns, rows), 0, {}};
  }
  const MacroGrid cells = MacroGrid::regular(frame, columns * fine, rows * fine);
  CoarseLoad load = coarse_load(Domain(whole.territory()), cells, horizons, staying, kCrossingCost / fine,
                                std::uint64_t{kCoarsePixelsPerNode} * cube.nodes());
  const RectilinearCuts cuts = balanced_cuts(load.map, columns, rows);
  std::vector<std::int64_t> column_edges, row_edges;
  for (const std::uint32_t c : cuts.columns) column_edges.push_back(cells.column_edges()[c - 1]);
  for (const std::uint32_t r : cuts.rows) row_edges.push_back(cells.row_edges()[r - 1]);
  for (LeavingLight& light : load.left_by_light) {
    light.from = {cell_of(light.from.column, cuts.columns), cell_of(light.from.row, cuts.rows)};
  }
  return {PartitionMode::kBalanced, MacroGrid(frame, std::move(column_edges), std::move(row_edges)),
          load.rays_per_primary, std::move(load.left_by_light)};
}

}  // namespace graycube
