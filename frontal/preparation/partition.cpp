#include "frontal/preparation/partition.hpp"

#include <algorithm>
#include <cstdlib>
#include <span>
#include <utility>
#include <vector>

#include "regions/jagged.hpp"
#include "regions/rectilinear.hpp"
#include "regions/slab_depths.hpp"
#include "trace/coarse_load.hpp"

namespace graycube {
namespace {

/// Cells of the coarse pre-render along each side of a macro-region, and at most along each side of
/// the grid: fewer when each cell is traced by itself. (With 16 nodes 4, 8 and 16 cells balance
/// csg10k to 0.80, 0.88 and 0.87.)
constexpr std::uint32_t kFineCells = 8;
constexpr std::uint32_t kLeastFineCells = 2;
constexpr std::uint32_t kMostCells = 64, kMostCellsApart = 32;
/// The cost to a node of a ray that comes in, in tests of a primitive. Its evaluators hardly notice
/// (their tracing counts by itself), but its mailroom decodes and stores the ray.
constexpr double kCrossingCost = 3;
/// Enough pixels to tell the work of a macro-region from that of the next, and to see which
/// occluders its shadow rays need.
constexpr std::uint32_t kCoarsePixelsPerNode = 512;
/// The pre-render subdivides the whole scene: unless balance is asked for, there must be this many
/// primary rays to each primitive.
constexpr std::uint64_t kPrimaryRaysPerPrimitive = 2;

/// The index of the part in which a fine cell is, parts being separated by `cuts`.
std::uint16_t cell_of(std::uint16_t fine, const std::vector<std::uint32_t>& cuts) {
  return static_cast<std::uint16_t>(std::upper_bound(cuts.begin(), cuts.end(), fine) -
                                    cuts.begin());
}

/// Strips of at most so many pixels are traced in packets that aren't full.
constexpr std::int64_t kNarrowStrip = 4;

/// Makes own pixels end with the macro-region if they nearly do; each node keeps some pixels.
void close_narrow_strips(std::span<const std::int64_t> region_edges,
                         std::span<std::int64_t> own_edges) {
  for (std::size_t i = 0; i < own_edges.size(); ++i) {
    const std::int64_t edge = region_edges[i];
    const bool follows = (i == 0 || own_edges[i - 1] < edge) &&
                         (i + 1 == own_edges.size() || edge < own_edges[i + 1]);
    if (follows && std::abs(own_edges[i] - edge) <= kNarrowStrip) own_edges[i] = edge;
  }
}

/// The inner edges with 0 before them and the picture's side behind them.
std::vector<std::int64_t> with_ends(const std::vector<std::int64_t>& inner, std::uint32_t side) {
  std::vector<std::int64_t> all{0};
  all.insert(all.end(), inner.begin(), inner.end());
  all.push_back(side);
  return all;
}

/// Whether each node's own pixels may be others than its macro-region's: their primary rays must
/// stay in their pyramid, and this must not be cut in depth.
bool may_be_jagged(const Domain& whole, const NodeMesh& mesh, std::uint32_t scatter,
                   Staying staying) {
  return staying.all() && scatter == 1 && mesh.slabs() == 1 && !whole.primary_rays_may_leave();
}

Partition jagged_partition(const MacroGrid& cells, const CameraFrame& frame, std::uint32_t columns,
                           std::uint32_t rows, CoarseLoad load) {
  JaggedCuts cuts = jagged_cuts(load.map, with_ends(cells.column_edges(), frame.image.width),
                                with_ends(cells.row_edges(), frame.image.height), columns, rows);
  const std::vector<std::int64_t> middle = mean_columns(cuts, columns);
  for (std::uint32_t row = 0; row < rows; ++row) {
    close_narrow_strips(middle,
                        std::span(cuts.columns).subspan(row * middle.size(), middle.size()));
  }
  MacroGrid grid(frame, middle, cuts.rows);
  for (LeavingLight& light : load.left_by_light) {
    light.from = grid.region_of_pixel(light.ray.pixel % frame.image.width,
                                      light.ray.pixel / frame.image.width);
  }
  return {PartitionMode::kBalanced, std::move(grid), std::move(cuts.columns), load.rays_per_primary,
          std::move(load.left_by_light)};
}

}  // namespace

Partition partition_of(const WholeScene& whole, const NodeMesh& mesh, std::uint32_t scatter,
                       PartitionMode wanted, const std::shared_ptr<const LightHorizons>& horizons,
                       Staying staying) {
  const Model& model = whole.model();
  const ImageSize& image = model.settings.image;
  const auto frame = CameraFrame::from(model.settings.camera, image);
  const std::uint32_t nodes = mesh.cube().nodes();
  const std::uint32_t columns = mesh.columns() * scatter, rows = mesh.rows() * scatter;
  const std::uint32_t most = staying.all() ? kMostCells : kMostCellsApart;
  const std::uint32_t fine =
      std::clamp(most / std::max(columns, rows), kLeastFineCells, kFineCells);
  const bool too_small = image.width < columns * fine * 2 || image.height < rows * fine * 2 ||
                         columns * fine > kMaxGridSide;
  const bool too_costly =
      wanted == PartitionMode::kAuto && !whole.has_primary_rays(kPrimaryRaysPerPrimitive);
  if (wanted == PartitionMode::kRegular || nodes == 1 || too_small || too_costly) {
    return {PartitionMode::kRegular,
            MacroGrid::regular(frame, columns, rows, even_slab_depths(model, frame, mesh.slabs())),
            {},
            0,
            {}};
  }
  const MacroGrid cells = MacroGrid::regular(frame, columns * fine, rows * fine);
  const Domain domain(whole.territory());
  CoarseLoad load = coarse_load(domain, cells, horizons, staying, kCrossingCost / fine,
                                std::uint64_t{kCoarsePixelsPerNode} * nodes);
  if (may_be_jagged(domain, mesh, scatter, staying))
    return jagged_partition(cells, frame, columns, rows, std::move(load));
  const RectilinearCuts cuts = balanced_cuts(load.map, columns, rows);
  std::vector<std::int64_t> column_edges, row_edges;
  for (const std::uint32_t c : cuts.columns) column_edges.push_back(cells.column_edges()[c - 1]);
  for (const std::uint32_t r : cuts.rows) row_edges.push_back(cells.row_edges()[r - 1]);
  MacroGrid grid(frame, std::move(column_edges), std::move(row_edges),
                 balanced_slab_depths(model, frame, mesh.slabs()));
  for (LeavingLight& light : load.left_by_light) {
    light.from = {cell_of(light.from.column, cuts.columns), cell_of(light.from.row, cuts.rows),
                  grid.region_of_point(light.ray.ray.origin).slab};
  }
  return {PartitionMode::kBalanced,
          std::move(grid),
          {},
          load.rays_per_primary,
          std::move(load.left_by_light)};
}

}  // namespace graycube
