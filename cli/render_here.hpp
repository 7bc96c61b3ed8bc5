// The reference: a scene rendered in this process.
#pragma once

#include <string>

#include "cli/display/progress.hpp"
#include "cli/scene_input.hpp"
#include "film/film.hpp"

namespace graycube {

struct Rendered {
  Picture picture;
  /// As of statistics_json.
  std::string stats;
  /// "serial, 4 threads".
  std::string summary;
  /// What it took another process, in CPU time, to write the picture's files; there are no pixels
  /// then.
  double written_cpu_s = 0;
};

/// Renders with the algorithm `serial`; no process, no socket.
Rendered render_here(SceneInput scene, const control::JobOptions& options, std::uint32_t threads,
                     ProgressDisplay& display);

}  // namespace graycube
