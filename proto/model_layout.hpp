// The layout of a model slice, shared by its writer and its reader. FORMAT.md describes it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "csg/model.hpp"

namespace graycube::model_layout {

inline constexpr std::size_t kHeaderBytes = 36;
inline constexpr std::size_t kSettingsBytes = 188;
inline constexpr std::size_t kLightBytes = 81;
/// Set beside a light's falloff when it casts no shadows.
inline constexpr std::uint8_t kShadowlessBit = 0x80;
inline constexpr std::size_t kMaterialBytes = 82;
/// The numbers of Torrance–Sparrow's and Hall–Greenberg's models; other materials have none.
inline constexpr std::size_t kOpticsBytes = (3 + 3 + 3 + 2) * 8;
/// The numbers of a pattern: its map, colours, thresholds and octaves, and its chart without maps;
/// materials without a pattern have none.
inline constexpr std::size_t kPatternBytes = (12 + 9 + 2 + 3) * 8 + 4 + 2 * 8;
/// Each map of a chart.
inline constexpr std::size_t kChartMapBytes = 12 * 8;
inline constexpr std::size_t kPlaneBytes = 32;
/// The three counts of a mesh; at least one point and one triangle follow.
inline constexpr std::size_t kMeshBytes = 12;
inline constexpr std::size_t kPointBytes = 24;
inline constexpr std::size_t kTriangleBytes = 12;
/// The number of a triangle's plane, written if the mesh lies in planes of other solids.
inline constexpr std::size_t kPlaneNumberBytes = 4;
/// The number of an outline's loops; each has its number of segments and three points a segment.
inline constexpr std::size_t kOutlineBytes = 4;
inline constexpr std::size_t kLoopBytes = 4;
inline constexpr std::size_t kSegmentBytes = 6 * 8;
inline constexpr std::size_t kNodeBytes = 5;
inline constexpr std::size_t kObjectBytes = 60;
/// Kind, flags and material; the parts that the flags name follow.
inline constexpr std::size_t kPrimitiveBytes = 7;

/// Bits 0 to 5 of a primitive's flags say that v[i] is not +0 and follows.
inline constexpr unsigned kHasMap = 1u << 6;
inline constexpr unsigned kHasBounds = 1u << 7;
inline constexpr unsigned kHasPlanes = 1u << 8;
inline constexpr unsigned kHasMesh = 1u << 9;
inline constexpr unsigned kHasOutline = 1u << 10;
inline constexpr unsigned kAllFlags = (1u << 11) - 1;

/// Whether all bits are equal: −0 is not +0.
inline bool same_bits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
inline bool same_bits(const Vec3& a, const Vec3& b) {
  return same_bits(a.x, b.x) && same_bits(a.y, b.y) && same_bits(a.z, b.z);
}

/// Which optional parts of a primitive are written: those that differ from Primitive{}.
inline unsigned flags_of(const Primitive& p) {
  static const Primitive plain;
  unsigned flags = 0;
  for (std::size_t i = 0; i < p.v.size(); ++i) {
    if (!same_bits(p.v[i], 0.0)) flags |= 1u << i;
  }
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 4; ++column) {
      if (!same_bits(p.to_local.m[row][column], plain.to_local.m[row][column])) flags |= kHasMap;
    }
  }
  if (!same_bits(p.bounds.lo, plain.bounds.lo) || !same_bits(p.bounds.hi, plain.bounds.hi)) {
    flags |= kHasBounds;
  }
  if (p.first_plane != 0 || p.plane_count != 0) flags |= kHasPlanes;
  if (p.mesh != 0) flags |= kHasMesh;
  if (p.outline != 0) flags |= kHasOutline;
  return flags;
}

inline std::size_t mesh_bytes(const TriangleMesh& mesh) {
  return kMeshBytes + mesh.points.size() * kPointBytes + mesh.triangles.size() * kTriangleBytes +
         mesh.planes.size() * kPlaneBytes + mesh.plane_of.size() * kPlaneNumberBytes;
}

constexpr std::size_t primitive_bytes(unsigned flags) {
  return kPrimitiveBytes + 8 * static_cast<std::size_t>(std::popcount(flags & 0x3Fu)) +
         ((flags & kHasMap) != 0 ? 96 : 0) + ((flags & kHasBounds) != 0 ? 48 : 0) +
         ((flags & kHasPlanes) != 0 ? 8 : 0) + ((flags & kHasMesh) != 0 ? 4 : 0) +
         ((flags & kHasOutline) != 0 ? 4 : 0);
}

inline bool is_inner(TreeNode::Kind kind) {
  return kind == TreeNode::Kind::kAnd || kind == TreeNode::Kind::kOr;
}

}  // namespace graycube::model_layout
