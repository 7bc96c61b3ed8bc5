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

struct BrlcadView {
  Camera camera;
  /// The width of the view in mm; of a perspective one, at its eye's distance.
  double size = 1;
};

/// The first view of a script: viewsize, eye_pt, viewrot or orientation or lookat_pt, perspective.
/// A command that is missing is an error.
std::optional<BrlcadView> read_brlcad_view(std::string_view script, BrlcadReport& report);

/// The view of rt -a AZIMUTH -e ELEVATION of a model with these (finite) bounds: parallel rays, and
/// the box's diagonal as wide as the picture, once the box is rounded outwards to whole
/// millimetres.
BrlcadView brlcad_view(double azimuth_degrees, double elevation_degrees, const Aabb& bounds);

/// The axes of the picture: right, up, and towards the eye.
struct BrlcadAxes {
  Vec3 right, up, backward;
};
BrlcadAxes brlcad_axes(const Camera& camera);

}  // namespace graycube
