// Charts: coordinates u and v, 0 … 1, on a solid's surface, for patterns that follow it. What u and
// v are on each kind of solid, and where they begin, is as BRL-CAD's librt has it (its primitives'
// functions rt_*_uv).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/affine.hpp"
#include "geometry/vec.hpp"

namespace graycube {

/// The coordinates x, y, z of a point are those that the chart's map gives it. Its longitude is the
/// angle from x towards y as a part of a full turn, 0 ≤ longitude < 1; r is its distance from z.
enum class ChartKind : std::uint8_t {
  kNone,
  kSphere,  // radius 1: u is the longitude, v goes from pole to pole
  kTorus,   // of radius 1 about z: u is the longitude, v the angle about the ring, from inside
  kRound,   // about z, from 0 to 1: u is the longitude, v is z; and each end has its own v
  kTrough,  // z from 0 to 1, y from −1 to 1, x from 0 to 1: u goes about x, v along it
  kPlane,   // u and v go with x and y from 0 to 1, and back again
  kFaces,   // flat faces: x and y are u and v, z is the distance from the face's plane
};
inline constexpr std::uint8_t kChartKinds = 7;

/// v on an end of a round solid: as elsewhere, 1 − r, or r.
enum class EndChart : std::uint8_t { kNone, kZeroAtRim, kOneAtRim };
inline constexpr std::uint8_t kEndCharts = 3;

/// Most faces of one chart.
inline constexpr std::size_t kMaxChartFaces = 6;

struct Chart {
  ChartKind kind = ChartKind::kNone;
  /// What v is on a round solid's ends, at z = 0 and z = 1.
  std::array<EndChart, 2> ends{EndChart::kNone, EndChart::kNone};
  /// A round solid's radii along x and y at z = 1, ≥ 0; at z = 0 they are 1.
  std::array<double, 2> top_radii{1, 1};
  /// From the world's coordinates to the solid's: one map; for faces one each, of which the nearest
  /// counts. Without a kind there is none.
  std::vector<Affine> maps;

  friend bool operator==(const Chart&, const Chart&) = default;
};

/// How many maps a chart may have.
constexpr std::size_t most_maps_of(ChartKind kind) {
  return kind == ChartKind::kNone ? 0 : kind == ChartKind::kFaces ? kMaxChartFaces : 1;
}

/// (u, v, 0) of the point p of the surface, in the world's coordinates: 0 … 1 whatever p is. The
/// chart must have a kind and its maps.
Vec3 chart_point(const Chart& chart, const Vec3& p);

}  // namespace graycube
