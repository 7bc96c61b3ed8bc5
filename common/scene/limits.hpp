// The limits of a scene, whatever file it comes from.
#pragma once

#include <cstdint>

namespace graycube {

/// The most levels of a CSG tree, with references expanded.
inline constexpr std::uint32_t kMaxTreeDepth = 256;
/// The most leaves of all objects, and nodes of any kind, with references expanded.
inline constexpr std::uint64_t kMaxLeaves = 1ull << 24;
inline constexpr std::uint64_t kMaxExpandedNodes = 1ull << 25;
/// The most leaves, nodes, planes of polyhedra and triangles of meshes that refs and repeats may
/// add to those that a file spells out, whose memory is in proportion to it: a few lines can name
/// 2^100.
inline constexpr std::uint64_t kMaxRepeatedLeaves = 1ull << 18;
inline constexpr std::uint64_t kMaxRepeatedNodes = 1ull << 23;
inline constexpr std::uint64_t kMaxRepeatedPlanes = 1ull << 21;
inline constexpr std::uint64_t kMaxRepeatedTriangles = 1ull << 21;
/// The most levels of a repeat, and maps of all repeats of a file together.
inline constexpr std::uint32_t kMaxRepeatDepth = 256;
inline constexpr std::uint32_t kMaxRepeatMaps = 1u << 20;
inline constexpr std::uint32_t kMaxMaterials = 1u << 20;
inline constexpr std::uint32_t kMaxShapes = 1u << 24;
inline constexpr std::uint32_t kMaxObjects = 1u << 24;
inline constexpr std::uint32_t kMaxPlanes = 1u << 16;
/// The most points of a prism, and corners of its paths.
inline constexpr std::uint32_t kMaxPrismPoints = 4096;
/// The most outlines of lathes and sweeps, and segments of all together. One has at most
/// kMaxOutlineSegments (outline/outline.hpp).
inline constexpr std::uint32_t kMaxOutlines = 65535;
inline constexpr std::uint32_t kMaxSegmentsOfOutlines = 1u << 20;

}  // namespace graycube
