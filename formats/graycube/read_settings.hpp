// The parts of a scene file that are not solids: picture, camera, lights.
#pragma once

#include <vector>

#include "formats/json/access.hpp"
#include "shading/settings.hpp"

namespace graycube {

void read_image(JsonAccess& json, JsonIndex at, ImageSize& out);
void read_camera(JsonAccess& json, JsonIndex at, Camera& out);
void read_lights(JsonAccess& json, JsonIndex at, std::vector<PointLight>& out);

}  // namespace graycube
