// How large faces may be.
#pragma once

#include <cstdint>

namespace graycube {

/// The most corners of a mesh's face: cutting takes up to 2 s, where it is bent up to 10 s.
inline constexpr std::uint32_t kMostFaceCorners = 1u << 17;

}  // namespace graycube
