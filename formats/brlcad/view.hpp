// rt's ways to tell where the eye is.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "formats/brlcad/database/report.hpp"
#include "geometry/aabb.hpp"
#include "shading/settings.hpp"

namespace graycube {

/// The first view of a script: viewsize, eye_pt, viewrot or orientation or lookat_pt, perspective.
/// A command that is missing is an error.
std::optional<Camera> read_brlcad_view(std::string_view script, BrlcadReport& report);

/// The camera of rt -a AZIMUTH -e ELEVATION for a model with these (finite) bounds: parallel rays,
/// the box's diagonal as wide as the picture.
Camera brlcad_camera(double azimuth_degrees, double elevation_degrees, const Aabb& bounds);

/// The axes of the picture: right, up, and towards the eye.
struct BrlcadAxes {
  Vec3 right, up, backward;
};
BrlcadAxes brlcad_axes(const Camera& camera);

}  // namespace graycube
