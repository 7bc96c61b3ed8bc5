// Figure 9 of the report: rays on their ways from node to node, and where they converge.
#pragma once

#include <string>
#include <string_view>

#include "figures/run_record.hpp"
#include "film/film.hpp"
#include "shading/settings.hpp"

namespace graycube::figures {

/// `settings` are those of the picture, for its lights and camera.
std::string traffic_svg(std::string_view scene, const Picture& picture,
                        const RenderSettings& settings, const Hypercube& cube,
                        const RunRecord& run);

/// How the run went, for a subtitle: empty if it ended well, else "; it ended in a deadlock".
std::string ending_text(const RunRecord& run);

}  // namespace graycube::figures
