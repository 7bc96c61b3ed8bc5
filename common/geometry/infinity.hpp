// The infinities, under the names that all code uses.
#pragma once

#include <limits>

namespace graycube {

inline constexpr double kInf = std::numeric_limits<double>::infinity();
inline constexpr float kFloatInf = std::numeric_limits<float>::infinity();

}  // namespace graycube
