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
    NamedChoice{"linked, extremal entry", {Subdivision::kLinked, Entry::kExtremal}},
    NamedChoice{"arnaldi", {Subdivision::kArnaldi}},
    NamedChoice{"arnaldi, descent", {Subdivision::kArnaldi, Entry::kDescent}},
    NamedChoice{"octree", {Subdivision::kOctree}},
    NamedChoice{"kaplan", {Subdivision::kKaplan}},
};

}  // namespace graycube::testing
