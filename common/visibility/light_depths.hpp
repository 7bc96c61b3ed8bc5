// Depth maps of what a light sees, for the directions in which a picture's surfaces ask for it. The
// whole scene is dilated and eroded by the half width of a texel (csg/morphology.hpp). Then one ray
// through a texel's middle speaks for all of its directions: none of them meets anything nearer
// than the first crossing of the dilated scene, and each is inside a solid where the eroded scene
// is first entered: beyond, there is no light.
#pragma once

#include <cstdint>

#include "crossings/surface_tree.hpp"
#include "visibility/light_horizons.hpp"

namespace graycube {

/// Texels of the darkness about all lights together, at most: what FORMAT.md allows on the wire.
inline constexpr std::uint64_t kMostDepthTexels = std::uint64_t{1} << 20;

/// The horizons with depths beside, of at most `most_texels` texels of darkness (and
/// kMostDepthTexels), where that helps. `whole` is the scene that they are of; its camera says
/// where its surfaces are seen.
LightHorizons with_depths(LightHorizons horizons, const SurfaceTree& whole,
                          std::uint64_t most_texels);

}  // namespace graycube
