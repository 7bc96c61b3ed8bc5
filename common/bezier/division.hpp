// How finely the patches of a net are cut, so that triangles keep within a tolerance of them and
// share all corners where patches meet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include "bezier/net.hpp"
#include "bezier/sides.hpp"
#include "mesh/close_mesh.hpp"

namespace graycube {

/// A side of a patch is cut into at most 2 to this power parts.
inline constexpr std::uint32_t kMaxBezierLevel = 12;
/// The tolerance of a net that names none, as a share of the longest side of its points' box.
inline constexpr double kDefaultBezierShare = 1e-4;

/// kDefaultBezierShare in the net's units.
double default_tolerance(const BezierNet& net);

struct BezierDivision {
  /// Along u and v a patch has 2 to these powers cells.
  struct Levels {
    std::uint32_t u = 0, v = 0;
  };
  std::vector<Levels> patches;
  BezierSides sides;
  /// The power for each curve of the sides: that of the finest patch that it bounds.
  std::vector<std::uint32_t> curves;
  /// Of all patches, no fewer than there will be.
  std::uint64_t triangles = 0;

  const BezierSides::Use& side(std::size_t patch, std::size_t s) const {
    return sides.patches[patch][s];
  }
};

/// Cuts a net so that its triangles are within `tolerance` > 0 of its patches, and these within it
/// of the triangles. Indices must be in range; the memory taken is in proportion to the net.
/// Faults: sides that don't meet another, a tolerance that takes more than kMaxMeshTriangles or
/// cells finer than kMaxBezierLevel.
std::variant<BezierDivision, MeshFault> division_of(const BezierNet& net, double tolerance);

}  // namespace graycube
