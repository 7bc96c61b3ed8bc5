// The scene reader. It finds all errors of a file in one run, each with its place; what it returns
// can be compiled and rendered without further doubt about its values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/json/padded_text.hpp"
#include "formats/json/scene_error.hpp"
#include "formats/mesh/mesh_file.hpp"
#include "scene/scene.hpp"

namespace graycube {

inline constexpr std::uint64_t kMaxSceneBytes = 0xFFFFFFFFull;  // 4 GiB − 1

struct ReadResult {
  /// Set exactly when there is no error.
  std::optional<Scene> scene;
  std::vector<SceneError> errors;
  /// Whether a mesh came from a file of its own: then the text alone isn't the scene.
  bool used_files = false;
  /// Whether one object at a time was read, without the tree of the whole text: this is done for
  /// CBOR as our writer writes it, without errors.
  bool was_read_in_pieces = false;
};

/// Reads a scene file's text (docs/scene.md). Never throws for what the text holds. `load`
/// opens the files that meshes name; without one such a mesh is an error.
ReadResult read_scene_text(const PaddedText& json, const MeshLoader& load = nullptr);
/// The same for a text without padding, which is copied. Large ones are best padded when read.
ReadResult read_scene_text(std::string_view json);
/// The same for a file; mesh files are relative to its folder. If the file can't be read, there is
/// one error with an empty pointer.
ReadResult read_scene_file(const std::filesystem::path& path);

}  // namespace graycube
