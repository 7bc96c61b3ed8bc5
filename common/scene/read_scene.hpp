// The scene reader. It finds all errors of a file in one run, each with its place; what it returns
// can be compiled and rendered without further doubt about its values.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mesh_file.hpp"
#include "scene/padded_text.hpp"
#include "scene/scene.hpp"

namespace graycube {

inline constexpr std::uint64_t kMaxSceneBytes = 0xFFFFFFFFull;  // 4 GiB − 1
/// Levels of a CSG tree, refs expanded.
inline constexpr std::uint32_t kMaxTreeDepth = 256;
/// Leaves of all objects, and nodes of any kind, refs expanded.
inline constexpr std::uint64_t kMaxLeaves = 1ull << 24;
inline constexpr std::uint64_t kMaxExpandedNodes = 1ull << 25;
inline constexpr std::uint32_t kMaxMaterials = 1u << 20;
inline constexpr std::uint32_t kMaxShapes = 1u << 24;
inline constexpr std::uint32_t kMaxObjects = 1u << 24;
inline constexpr std::uint32_t kMaxPlanes = 1u << 16;
/// Points of a prism, and corners of its paths.
inline constexpr std::uint32_t kMaxPrismPoints = 4096;
/// Significant digits that a double may need to be told from its neighbours.
inline constexpr std::uint32_t kMaxDigits = 17;
/// Further errors are only counted.
inline constexpr std::size_t kMaxReportedErrors = 100;

struct SceneError {
  /// RFC 6901; empty for the whole file.
  std::string pointer;
  /// What was expected and what was found.
  std::string message;
  /// Where that value begins in the text, from 1; 0 when there is no such place.
  std::uint64_t line = 0, column = 0;
};

struct ReadResult {
  /// Set exactly when there is no error.
  std::optional<Scene> scene;
  std::vector<SceneError> errors;
  /// A mesh came from a file of its own: the text alone isn't the scene.
  bool used_files = false;
  /// An object at a time, without the tree of the whole text: CBOR as our writer writes it, without
  /// errors.
  bool was_read_in_pieces = false;
};

/// Reads a scene file's text (README, "Scene file"). Never throws for what the text holds. `load`
/// opens the files that meshes name; without one such a mesh is an error.
ReadResult read_scene_text(const PaddedText& json, const MeshLoader& load = nullptr);
/// As above, copying the text. Large ones are best padded where they are read.
ReadResult read_scene_text(std::string_view json);
/// As the first, with mesh files relative to the scene file's folder; that the file can't be read
/// is an error with an empty pointer.
ReadResult read_scene_file(const std::filesystem::path& path);

}  // namespace graycube
