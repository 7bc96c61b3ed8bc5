#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace graycube {

struct PovScene {
  /// A scene description of POV-Ray 3.7. Its first lines tell the command that renders it.
  std::string text;
  /// Things that POV-Ray computes in another way than Graycube, one sentence each.
  std::vector<std::string> warnings;
  /// Things that can't be written at all; if there are any, the text is of no use.
  std::vector<std::string> errors;
};

/// The scene for POV-Ray. For scenes that both can represent, the two compute the same light
/// (docs/scene.md, "Shading"). The scene must be one that the reader could have given.
PovScene write_pov(const Scene& scene);

}  // namespace graycube
