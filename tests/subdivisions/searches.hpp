// All ways to find crossings ray by ray.
#pragma once

#include <array>

#include "subdivisions/crossing_search.hpp"

namespace graycube::testing {

struct NamedChoice {
  const char* name;
  SubdivisionChoice choice;
};
inline constexpr std::array kAllSearches{
    NamedChoice{"roth", {Subdivision::kRoth}},
    NamedChoice{"linked", {Subdivision::kLinked}},
    NamedChoice{"octree", {Subdivision::kOctree}},
    NamedChoice{"kaplan", {Subdivision::kKaplan}},
};

}  // namespace graycube::testing
