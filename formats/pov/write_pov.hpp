#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace graycube {

struct PovScene {
  /// Scene description language of POV-Ray 3.7. Its first lines tell the command that renders it.
  std::string text;
  /// What POV-Ray can't compute as Graycube does, one sentence each.
  std::vector<std::string> warnings;
  /// What can't be written at all; then the text is of no use.
  std::vector<std::string> errors;
};

/// The scene for POV-Ray. On what both can represent the two compute the same light (docs/scene.md,
/// "Shading"). The scene must be one that the reader could have given.
PovScene write_pov(const Scene& scene);

}  // namespace graycube
