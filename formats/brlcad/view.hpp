// rt's ways to say where the eye is.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "formats/brlcad/report.hpp"
#include "geometry/aabb.hpp"
#include "shading/settings.hpp"

namespace graycube {

/// The first view of a script: viewsize, eye_pt, viewrot or orientation or lookat_pt, perspective.
/// What is missing is an error. `size` is the picture's.
std::optional<Camera> read_brlcad_view(std::string_view script, BrlcadReport& report);

/// What rt -a AZIMUTH -e ELEVATION shows of a model with these (finite) bounds: parallel rays, the
/// box's diagonal as wide as the picture.
Camera brlcad_camera(double azimuth_degrees, double elevation_degrees, const Aabb& bounds);

/// The axes of the picture: right, up, and towards the eye.
struct BrlcadAxes {
  Vec3 right, up, backward;
};
BrlcadAxes brlcad_axes(const Camera& camera);

}  // namespace graycube
