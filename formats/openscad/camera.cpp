#include "formats/openscad/camera.hpp"

#include <cmath>

#include "formats/openscad/language/limits.hpp"
#include "geometry/affine.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

constexpr double kDegrees = 57.295779513082320877;

}  // namespace

std::optional<Camera> camera_of(const OpenscadView& view, const ImageSize& image) {
  const bool is_good = max_abs(view.target) <= kMaxOpenscadCoordinate && is_finite(view.rotation) &&
                       view.distance > 0 && view.distance <= kMaxOpenscadCoordinate &&
                       view.fov_degrees > 0 && view.fov_degrees < 180;
  if (!is_good) return std::nullopt;
  const Affine turn =
      compose(rotation({0, 0, 1}, view.rotation.z),
              compose(rotation({0, 1, 0}, view.rotation.y), rotation({1, 0, 0}, view.rotation.x)));
  // OpenSCAD's angle is the one from bottom to top.
  const double across = tan_degrees(0.5 * view.fov_degrees) * image.width / image.height;
  Camera camera;
  camera.projection = Projection::kPerspective;
  camera.look_at = view.target;
  camera.eye = view.target + view.distance * turn.vector({0, 0, 1});
  camera.up = turn.vector({0, 1, 0});
  camera.fov_degrees = 2 * kDegrees * std::atan(across);
  camera.handedness = Handedness::kRight;
  // The eye must differ from what it looks at.
  if (camera.eye == camera.look_at || !(camera.fov_degrees < 180)) return std::nullopt;
  return camera;
}

}  // namespace graycube
