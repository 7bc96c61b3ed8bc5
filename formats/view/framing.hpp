// The camera and lights for a file that names none: how far a solid reaches in the few directions
// that matter for that, and the view that shows all of it.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "formats/view/frame.hpp"
#include "geometry/aabb.hpp"
#include "geometry/affine.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// The view of OpenSCAD's window, rotation [55, 0, 25], as unit vectors: `right` and `up` in the
/// picture.
struct ViewAxes {
  Vec3 right, up, forward;
  static ViewAxes standard();
};

/// Directions n along which the largest n · p over a solid is kept: the six half-axes first (+x,
/// −x, +y, …), then the normals of the four sides of the picture's pyramid (right, left, upper,
/// lower), not unit.
inline constexpr std::size_t kReachDirections = 10;
using ReachDirections = std::array<Vec3, kReachDirections>;
ReachDirections reach_directions(const Frame& frame);

/// An upper bound of n · p over a solid, for each direction; −infinity everywhere for the empty
/// one.
struct Reach {
  std::array<double, kReachDirections> along;

  static Reach nothing();
  Aabb box() const;
};
Reach union_of(const Reach& a, const Reach& b);
Reach intersection_of(const Reach& a, const Reach& b);
/// The reach of a leaf under `to_world`; `corners` are those of a solid that is one polyhedron. It
/// is exact up to rounding.
Reach reach_of(const CsgNode& leaf, std::span<const Vec3> corners, const Affine& to_world,
               const ReachDirections& directions);

/// Camera, lights, background and all other settings for a solid with this reach. An empty solid is
/// framed like the cube [−1, 1]³.
RenderSettings framed_settings(const Reach& reach, const Frame& frame);

}  // namespace graycube
