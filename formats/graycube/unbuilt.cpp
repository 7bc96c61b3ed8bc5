#include "formats/graycube/unbuilt.hpp"

#include <string>

#include "json_pointer.hpp"

namespace graycube {

std::vector<SceneError> unbuilt_parts(const Scene& scene) {
  std::vector<SceneError> errors;
  for (const NamedMaterial& m : scene.materials) {
    if (m.material.model != ShadingModel::kTorranceSparrow &&
        m.material.model != ShadingModel::kHallGreenberg)
      continue;
    std::string pointer;
    for (const std::string_view token :
         {std::string_view("materials"), std::string_view(m.name), std::string_view("model")})
      append_token(pointer, token);
    errors.push_back(
        {.pointer = std::move(pointer), .message = "not built yet; \"phong\" and \"rt\" are"});
  }
  return errors;
}

}  // namespace graycube
