// Figure 4 of the report: a scene cut by a BSP.
#pragma once

#include <string>
#include <string_view>

#include "figures/leaf_space.hpp"
#include "film/film.hpp"

namespace graycube::figures {

/// For `arnaldi` the regions of the screen over the picture, for `linked` the leaf regions along
/// the fullest section across the axis nearest to the view, beside the picture.
std::string bsp_svg(std::string_view scene, const Picture& picture, const LeafSpace& space);

}  // namespace graycube::figures
