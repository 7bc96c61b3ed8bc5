// Where the slabs of a three-dimensional mesh end.
#pragma once

#include <cstdint>
#include <vector>

#include "csg/model.hpp"
#include "regions/camera.hpp"

namespace graycube {

/// Depths along the view between slabs, above 0 and strictly increasing: one fewer than `slabs`,
/// which is 1 … kMaxSlabs. Both look at bounded objects alone; where none of these is in front of
/// the eye, slabs are as deep as the scene's unit.
///
/// Slabs of equal depth between the nearest and the farthest point of the scene.
std::vector<double> even_slab_depths(const Model& model, const CameraFrame& frame,
                                     std::uint32_t slabs);
/// Slabs with equally many of the primitives in front of the eye, each counted at its middle. Even
/// ones where too many of these middles are equally deep.
std::vector<double> balanced_slab_depths(const Model& model, const CameraFrame& frame,
                                         std::uint32_t slabs);

}  // namespace graycube
