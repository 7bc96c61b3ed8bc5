// Figure 8 of the report: how a ray from a neighbour finds its entry region.
#pragma once

#include <string>
#include <string_view>

#include "figures/entry_way.hpp"

namespace graycube::figures {

std::string entry_svg(std::string_view scene, const ShownEntry& entry);

}  // namespace graycube::figures
