// Scenes as files: read, imported, checked, and as the text that goes to a farm.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/failure.hpp"
#include "proto/messages.hpp"
#include "scene/scene.hpp"

namespace graycube {

struct SceneInput {
  /// The file's name without folders.
  std::string name;
  Scene scene;
  /// A scene file's text: the file's own, or what its import gives.
  std::string text;
  /// From the importer; `where` is FILE:LINE.
  std::vector<Problem> warnings;
};

/// Reads SCENE (.json, or .csg from OpenSCAD) and finds all its errors. `options` gives a picture's
/// size and depth to import for. Throws a Failure of status 2 with a problem for each error,
/// `scene: FILE:POINTER: MESSAGE`.
SceneInput read_scene_input(const std::filesystem::path& path,
                            const control::JobOptions& options = {});

/// Throws a Failure of status 2 when the scene asks for something that the format has and this
/// version can't compute.
void check_is_built(const std::filesystem::path& path, const Scene& scene);

/// The options' overrides, applied.
void apply_overrides(const control::JobOptions& options, RenderSettings& settings);

/// Throws a Failure of status 2 when the scene can't be rendered but by `serial`.
void check_farm_limits(const SceneInput& input, const RenderSettings& settings);

}  // namespace graycube
