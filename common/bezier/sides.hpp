// Which sides of Bézier patches meet: those with the same four control points.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bezier/net.hpp"
#include "geometry/vec.hpp"
#include "mesh/close_mesh.hpp"

namespace graycube {

/// A curve that bounds patches, shared by all that it bounds.
struct BezierCurve {
  /// Numbers of the control points; points with equal coordinates have the same number.
  std::array<std::uint32_t, 4> points{};

  /// Whether the curve is a single point, as at a pole.
  bool is_point() const {
    return points[0] == points[1] && points[0] == points[2] && points[0] == points[3];
  }
  /// Whether the curve runs back over itself.
  bool is_fold() const { return points[0] == points[3] && points[1] == points[2]; }
};

struct BezierSides {
  /// A side of a patch: its curve, and whether it runs along it backwards.
  struct Use {
    std::uint32_t curve = 0;
    bool is_backward = false;
  };
  std::vector<BezierCurve> curves;
  /// The sides of each patch, going round: v = 0, u = 1, v = 1, u = 0.
  std::vector<std::array<Use, 4>> patches;
};

/// The control points of a patch's side, in the sense in which BezierSides goes round.
std::array<std::uint32_t, 4> side_of(const BezierPatch& patch, std::size_t side);

BezierSides sides_of(const BezierNet& net);

/// Why the sides don't close up: some curve bounds a patch alone, or more patches one way than the
/// other. (Two that run the same way only need one patch turned over.)
std::optional<MeshFault> open_side(const BezierNet& net, const BezierSides& sides);

}  // namespace graycube
