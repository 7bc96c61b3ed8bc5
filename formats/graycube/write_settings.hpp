// Writes the parts of a scene file that are not solids, as read_settings.hpp reads them: each as
// the value of a member.
#pragma once

#include "formats/graycube/json_text.hpp"
#include "shading/settings.hpp"

namespace graycube {

void write_camera(JsonText& json, const Camera& camera);
void write_light(JsonText& json, const PointLight& light);

}  // namespace graycube
