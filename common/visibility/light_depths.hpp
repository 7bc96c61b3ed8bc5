// Depth maps of the scene seen from a light, for the directions in which the picture's surfaces
// look for it. The whole scene is dilated and eroded by the half width of a texel
// (csg/morphology.hpp). Then one ray through a texel's middle speaks for all of its directions:
// none of them meets anything nearer than the first crossing of the dilated scene, and each is
// inside a solid where the eroded scene is first entered: no light arrives beyond that.
#pragma once

#include <cstdint>

#include "crossings/surface_tree.hpp"
#include "visibility/light_horizons.hpp"

namespace graycube {

/// The most texels of darkness for all lights together: the limit of FORMAT.md on the wire.
inline constexpr std::uint64_t kMostDepthTexels = std::uint64_t{1} << 20;

/// Adds depths to the horizons where they help, with at most `most_texels` texels of darkness (and
/// at most kMostDepthTexels). `whole` is the scene of the horizons; its camera says which surfaces
/// are seen.
LightHorizons with_depths(LightHorizons horizons, const SurfaceTree& whole,
                          std::uint64_t most_texels);

}  // namespace graycube
