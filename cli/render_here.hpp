// The reference: a scene rendered in this process.
#pragma once

#include <string>

#include "cli/checkpoint.hpp"
#include "cli/display/progress.hpp"
#include "cli/scene_input.hpp"
#include "film/film.hpp"

namespace graycube {

struct Rendered {
  Picture picture;
  /// A text of statistics_json.
  std::string stats;
  /// A summary for people, such as "serial, 4 threads".
  std::string summary;
  /// CPU seconds that another process took to write the picture's files; then there are no pixels
  /// here.
  double written_cpu_s = 0;
};

/// Renders with the algorithm `serial`; no process, no socket. With a checkpoint it goes on from
/// that; interrupts, which must be held then, end it with a Failure once what is done is recorded.
Rendered render_here(SceneInput scene, const control::JobOptions& options, std::uint32_t threads,
                     ProgressDisplay& display, Checkpoint* checkpoint = nullptr);

}  // namespace graycube
