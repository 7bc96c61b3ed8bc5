// Where the boundaries of the macro-regions go.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "frontal/preparation/whole_scene.hpp"
#include "proto/messages.hpp"
#include "regions/macro_grid.hpp"
#include "topology/hypercube.hpp"
#include "trace/coarse_load.hpp"
#include "visibility/light_horizons.hpp"

namespace graycube {

struct Partition {
  /// What was picked: never kAuto.
  PartitionMode mode = PartitionMode::kRegular;
  MacroGrid grid;
  /// Own pixels, as own_pixels.hpp says.
  std::vector<std::int64_t> own_edges;
  /// As CoarseLoad says; 0 where there was no pre-render.
  double rays_per_primary = 0;
  /// As CoarseLoad says, `from` being a macro-region of the grid.
  std::vector<LeavingLight> left_by_light;
};

/// For a scene that `cube` renders, with `scatter` × `scatter` macro-regions a node. A picture too
/// small for a coarse pre-render is cut regularly whatever is `wanted`; kAuto also where the
/// pre-render would not be small beside the picture. Where all rays stay in the pre-render, work
/// lies where pixels are: then each row of nodes cuts its part of the picture by itself, and
/// macro-regions lie about there. `horizons` may be null.
Partition partition_of(const WholeScene& whole, const Hypercube& cube, std::uint32_t scatter,
                       PartitionMode wanted, const std::shared_ptr<const LightHorizons>& horizons,
                       Staying staying);

}  // namespace graycube
