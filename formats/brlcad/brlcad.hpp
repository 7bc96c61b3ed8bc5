// BRL-CAD databases as scenes: text (.asc) and binaries (.g) of versions 4 and 5. Regions become
// objects; the camera is rt's.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "formats/brlcad/database/report.hpp"
#include "scene/scene.hpp"

namespace graycube {

inline constexpr std::size_t kMaxBrlcadLeaves = std::size_t{1} << 21;
/// Most combinations nested in each other, and most levels of one region's whole tree.
inline constexpr std::size_t kMaxBrlcadNesting = 100;
inline constexpr std::size_t kMaxBrlcadLevels = 240;
inline constexpr std::size_t kMaxBrlcadViewBytes = std::size_t{1} << 20;

struct BrlcadOptions {
  ImageSize image{512, 512, 1};
  std::uint32_t max_depth = 5;
  /// The names of the objects to render; if empty, all that nothing refers to.
  std::vector<std::string> objects;
  /// The text of a view script as rt reads it; without one, azimuth and elevation count.
  std::optional<std::string> view;
  double azimuth_degrees = 35, elevation_degrees = 25;
};

struct BrlcadResult {
  /// Set exactly when there is no error.
  std::optional<Scene> scene;
  std::vector<BrlcadMessage> errors;
  std::vector<ImportWarning> warnings;
};

/// Never throws, whatever `bytes` or the view hold.
BrlcadResult read_brlcad(std::string_view bytes, const BrlcadOptions& options = {});

/// An object that nothing refers to, and how often solids occur below it.
struct BrlcadTop {
  std::string name;
  std::uint64_t primitives = 0;
};
struct BrlcadTops {
  std::vector<BrlcadTop> tops;
  std::vector<BrlcadMessage> errors;
};
BrlcadTops list_brlcad_tops(std::string_view bytes);

}  // namespace graycube
