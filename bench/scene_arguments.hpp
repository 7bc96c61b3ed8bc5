// The command line that the programs which render one scene file share.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "scene/scene.hpp"
#include "subdivisions/subdivision.hpp"

namespace graycube::bench {

struct SceneArguments {
  std::filesystem::path scene;
  /// --size N: the picture is N × N instead of what the file says.
  std::optional<std::uint32_t> size;
  /// --threads T
  std::uint32_t threads = 1;
  /// --exr OUT.exr
  std::optional<std::filesystem::path> exr;
  /// --build-only: don't trace.
  bool build_only = false;
  /// --subdivision WAY, --entry descent|extremal
  SubdivisionChoice subdivision;
};

/// Reads the scene, with the size asked for. Throws std::runtime_error with the reader's first
/// message.
Scene load(const SceneArguments& arguments);

/// Parses the command line and calls `run`; catches what it throws. Returns main's status: 0, 1
/// when `run` threw, 2 on bad usage.
int run_with_scene(const char* program, int argc, char** argv,
                   const std::function<void(const SceneArguments&)>& run);

}  // namespace graycube::bench
