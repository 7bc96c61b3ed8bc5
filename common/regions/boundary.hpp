// The planes between macro-regions.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "crossings/ray_packet.hpp"
#include "geometry/vec.hpp"

namespace graycube {

/// Boundary f(q) = normal · q − offset, with q relative to the eye and |normal| = 1. Relative to
/// the eye, so that f is exactly 0 at the origin of every primary ray in perspective, where offset
/// is 0.
struct BoundaryPlane {
  Vec3 normal;
  double offset = 0;
  /// Rays whose |normal · direction| is not above this count as parallel to the plane.
  double flat = 0;

  double at(const Vec3& q) const { return dot(normal, q) - offset; }
};

/// One bounding half-space of a column, row or slab, and where it leads.
struct RegionSide {
  BoundaryPlane plane;
  bool far = false;  // the half-space is f ≥ 0, else f < 0
  /// Only with three columns: from column 0 the root leads to column 1 in front of the eye and to
  /// column 2 behind it; boundary 2 tells which.
  bool forks = false;
  std::uint16_t next = 0;
};

/// The most sides that a region has: those of its column, of its row and of its slab.
inline constexpr std::size_t kMostSides = 6;

/// For each ray of a packet, the first side of its region that it passes.
struct FirstPassages {
  /// The parameter at which the ray passes it; infinite if it never does.
  alignas(64) std::array<double, RayPacket::kSize> t;
  /// The side's index among those given to find_first_passages().
  alignas(64) std::array<double, RayPacket::kSize> side;
};

/// Like MacroGrid::exit(), bit for bit, for each ray of the packet, all of which have reached their
/// t0. There are at most kMostSides sides; at equal t the first of them is taken.
void find_first_passages(std::span<const RegionSide* const> sides, const Vec3& eye,
                         const RayPacket& packet, FirstPassages& first);

}  // namespace graycube
