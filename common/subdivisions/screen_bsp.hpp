// The subdivision of Arnaldi, Priol and Bouatouch (1987), of one half of space (camera_space.hpp):
// a BSP of the screen, whose planes stand at the edges of the primitives' bounding volumes
// projected onto it, so that empty screen is cut off first; then every region that holds something
// is cut in depth by the volumes' faces across the view.
//
// A primitive is in the cells that its bounding volume touches, and out of finite ones that
// `classify` finds it to miss or to fill. Unbounded primitives are in all others, and in all that
// aren't finite.
#pragma once

#include "crossings/bsp.hpp"
#include "subdivisions/camera_space.hpp"

namespace graycube {

/// Axes 0, 1 and 2 of the result are the space's coordinates.
Bsp build_screen_bsp(const Model& model, const CameraSpace& space);

}  // namespace graycube
