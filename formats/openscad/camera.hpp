// The camera of a model that sets its view.
#pragma once

#include <optional>

#include "formats/openscad/language/options.hpp"
#include "shading/settings.hpp"

namespace graycube {

/// OpenSCAD's perspective camera for a picture of this size: it turns about `target`, looking down
/// from `distance` before it is turned about x, y and z (OpenSCAD 2021.01, Camera.cc and
/// GLView.cc). Nothing if the view has numbers that no camera can have.
std::optional<Camera> camera_of(const OpenscadView& view, const ImageSize& image);

}  // namespace graycube
