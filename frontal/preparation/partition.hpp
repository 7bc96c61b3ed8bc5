// Chooses the boundaries of the macro-regions.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "frontal/preparation/whole_scene.hpp"
#include "proto/messages.hpp"
#include "regions/macro_grid.hpp"
#include "topology/node_mesh.hpp"
#include "trace/coarse_load.hpp"
#include "visibility/light_horizons.hpp"

namespace graycube {

struct Partition {
  /// The mode that was picked; never kAuto.
  PartitionMode mode = PartitionMode::kRegular;
  MacroGrid grid;
  /// Edges of the nodes' own pixels, as own_pixels.hpp describes them.
  std::vector<std::int64_t> own_edges;
  /// See CoarseLoad; 0 when there was no pre-render.
  double rays_per_primary = 0;
  /// See CoarseLoad; `from` is a macro-region of the grid.
  std::vector<LeavingLight> left_by_light;
};

/// Cuts a scene that the nodes of `mesh` render into `scatter` × `scatter` macro-regions per node.
/// A picture too small for a coarse pre-render is cut regularly whatever is `wanted`; kAuto does
/// so, too, when the pre-render would not be small beside the picture. When all rays stay in the
/// pre-render, work lies where pixels are: then each row of nodes cuts its part of the picture by
/// itself, and macro-regions lie about there, unless there are slabs: these hold equally many
/// primitives. `horizons` may be null.
Partition partition_of(const WholeScene& whole, const NodeMesh& mesh, std::uint32_t scatter,
                       PartitionMode wanted, const std::shared_ptr<const LightHorizons>& horizons,
                       Staying staying);

}  // namespace graycube
