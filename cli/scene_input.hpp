// Scenes as files: read, imported, checked, and as the text that goes to a farm.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cli/failure.hpp"
#include "proto/messages.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// What to show of a file that holds a model without a view: a BRL-CAD database or an OpenSCAD
/// model.
struct ModelChoice {
  /// OpenSCAD: everything round as OpenSCAD would make it of facets.
  bool facets = false;
  /// All that nothing refers to, when empty.
  std::vector<std::string> objects;
  /// A view script of rt's; empty for azimuth and elevation.
  std::filesystem::path view;
  double azimuth_degrees = 35, elevation_degrees = 25;
  /// Whether any option for BRL-CAD was given: other files have no use for them.
  bool is_given = false;
};

struct SceneInput {
  /// The file's name without folders.
  std::string name;
  Scene scene;
  /// A scene file's own text; empty for what was imported or needs other files, until it is
  /// prepared for a farm.
  std::string text;
  /// From the importer; `where` is FILE:LINE.
  std::vector<Problem> warnings;
};

/// Reads SCENE (.json, .cbor; .scad or .csg of OpenSCAD; .g or .asc from BRL-CAD; .stl or .off, one
/// mesh) and finds all its errors. `options` gives a picture's size and depth to import for. Throws
/// a Failure of status 2 with a problem for each error, `scene: FILE:POINTER: MESSAGE`.
SceneInput read_scene_input(const std::filesystem::path& path,
                            const control::JobOptions& options = {},
                            const ModelChoice& choice = {});

/// How the names of files end that read_scene_input reads.
inline constexpr std::array<std::string_view, 8> kSceneEndings{".json", ".cbor", ".scad", ".csg",
                                                               ".g",    ".asc",  ".stl",  ".off"};
/// All of them: ".json, .cbor, … .stl or .off".
std::string scene_endings_text();

/// Whether the file is OpenSCAD's, by its name's ending.
bool is_openscad(const std::filesystem::path& path);
/// Whether the file is a BRL-CAD database, by its name's ending.
bool is_brlcad(const std::filesystem::path& path);

/// A database's top-level objects, each with its number of primitives, in lines; throws as above.
std::string brlcad_tops_text(const std::filesystem::path& path);

/// Throws a Failure of status 2 when the scene asks for something that the format has and this
/// version can't compute.
void check_is_built(const std::filesystem::path& path, const Scene& scene);

/// Makes the scene ready to be sent: with its text, and within a farm's limits. Throws a Failure of
/// status 2 when the scene, with the options' overrides, can't be rendered but by `serial`.
void prepare_for_farm(SceneInput& input, const control::JobOptions& options);

}  // namespace graycube
