// Scenes from files: read, imported and checked, and as the text that goes to a farm.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cli/failure.hpp"
#include "proto/messages.hpp"
#include "scene/compile_scene.hpp"
#include "scene/scene.hpp"

namespace graycube {

/// Options that choose what to show of a file that holds a model without a view: a BRL-CAD database
/// or an OpenSCAD model.
struct ModelChoice {
  /// For OpenSCAD: round solids are made of facets, as OpenSCAD makes them.
  bool facets = false;
  /// A part of a model that can't be had is an error, not left out with a warning.
  bool is_strict = false;
  /// Nothing is told of how long it takes.
  bool is_quiet = false;
  /// For mesh files: open ones are repaired (mesh/repair_mesh.hpp).
  bool repairs = false;
  /// For BRL-CAD: the objects to show; if empty, all that nothing refers to.
  std::vector<std::string> objects;
  /// The file of a view script for rt; if empty, azimuth and elevation count.
  std::filesystem::path view;
  double azimuth_degrees = 35, elevation_degrees = 25;
  /// Whether any option for BRL-CAD was given: other files have no use for them.
  bool is_given = false;
};

struct SceneInput {
  std::filesystem::path path;
  /// The file's name without folders.
  std::string name;
  Scene scene;
  /// A scene file's own text. Empty for a scene that was imported or needs other files, until it is
  /// prepared for a farm.
  std::string text;
  /// The importer's warnings; `where` is FILE:LINE.
  std::vector<Problem> warnings;
};

/// Reads SCENE (.json, .cbor; .scad or .csg of OpenSCAD; .g or .asc from BRL-CAD; .stl, .off and
/// others, meshes) and finds all its errors. `options` gives a picture's size and depth to import
/// for. Throws a Failure of status 2 with a problem for each error, `scene: FILE:POINTER: MESSAGE`.
SceneInput read_scene_input(const std::filesystem::path& path,
                            const control::JobOptions& options = {},
                            const ModelChoice& choice = {});

/// The endings of the file names that read_scene_input reads.
inline constexpr std::array<std::string_view, 18> kSceneEndings{
    ".json", ".cbor", ".scad", ".csg", ".g",   ".asc", ".stl", ".off", ".obj",
    ".ply",  ".3mf",  ".gltf", ".glb", ".dae", ".3ds", ".amf", ".x3d", ".fbx"};
/// All endings as text: ".json, .cbor, … .x3d or .fbx".
std::string scene_endings_text();

/// Whether the file is OpenSCAD's, by its name's ending.
bool is_openscad(const std::filesystem::path& path);
/// Whether the file is a BRL-CAD database, by its name's ending.
bool is_brlcad(const std::filesystem::path& path);

/// A line for each top-level object of a database, with its number of primitives; throws as above.
std::string brlcad_tops_text(const std::filesystem::path& path);

/// Compiles the scene; throws a Failure of status 2 with a problem for each solid, light or setting
/// that can't be computed. These are named by JSON pointers for scene files, and by their objects,
/// which importers name after their places, for others.
Model compile_input(const SceneInput& input);

/// Throws a Failure of status 2 with a problem for each setting with which only `serial` can render
/// the scene.
void check_farm_limits(const SceneInput& input, const RenderSettings& settings);

/// Makes the scene ready to be sent: with its text, and within a farm's limits. Throws a Failure of
/// status 2 when only `serial` can render the scene with the options' overrides.
void prepare_for_farm(SceneInput& input, const control::JobOptions& options);

}  // namespace graycube
