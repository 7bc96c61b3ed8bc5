// Walking a ray through the leaf regions of a BSP by neighbour links.
#pragma once

#include <cmath>
#include <optional>

#include "crossings/bsp.hpp"
#include "crossings/crossings.hpp"
#include "crossings/mailbox.hpp"

namespace graycube {

/// A ray prepared for comparing plane parameters with t; sides are never decided by coordinates.
class PlaneOrder {
 public:
  explicit PlaneOrder(const Ray& ray) : origin_(ray.origin) {
    for (int a = 0; a < 3; ++a) {
      const double d = ray.direction[a];
      const double inverse = 1.0 / d;
      const bool moves = std::isfinite(inverse);
      inverse_[a] = moves ? inverse : 0;
      sense_[static_cast<std::size_t>(a)] = !moves ? 0 : d > 0 ? 1 : -1;
    }
  }

  int sense(int axis) const { return sense_[static_cast<std::size_t>(axis)]; }
  double parameter(int axis, double at) const { return (at - origin_[axis]) * inverse_[axis]; }
  /// Whether the ray is on the upper side of the plane at parameter t.
  bool is_above(int axis, double at, double t) const {
    switch (sense(axis)) {
      case 1: return t >= parameter(axis, at);
      case -1: return t < parameter(axis, at);
      default: return origin_[axis] >= at;
    }
  }

 private:
  Vec3 origin_, inverse_;
  std::array<int, 3> sense_{};
};

/// The leaf region below `node` that the ray is in at parameter t.
inline const BspLeaf& leaf_at(const Bsp& bsp, std::uint32_t node, const PlaneOrder& order,
                              double t) {
  for (;;) {
    const BspNode& n = bsp.nodes()[node];
    if (n.axis == BspNode::kLeafAxis) return bsp.leaves()[n.child];
    node = n.child + (order.is_above(n.axis, n.split, t) ? 1u : 0u);
  }
}

/// The parameter at which a ray leaves a cell, and the face (axis · 2 + upper) through which it
/// does; face −1 when it stays for good.
struct CellExit {
  double t;
  int face;
};
inline CellExit exit_of(const Aabb& cell, const PlaneOrder& order) {
  CellExit exit{kInf, -1};
  for (int a = 0; a < 3; ++a) {
    const int sense = order.sense(a);
    if (sense == 0) continue;
    const double at = sense > 0 ? cell.hi[a] : cell.lo[a];
    if (!std::isfinite(at)) continue;
    const double t = order.parameter(a, at);
    if (exit.face < 0 || t < exit.t) exit = {t, a * 2 + (sense > 0 ? 1 : 0)};
  }
  return exit;
}

/// Calls `visit(leaf, t0, t1)` for the leaf regions along the ray, which together cover [t0, t1) in
/// half-open pieces, until it returns false or the ray has left; returns false in the first case.
template <typename Visit>
bool walk(const Bsp& bsp, const Ray& ray, double t0, double t1, Mailbox& mailbox, Visit&& visit) {
  const PlaneOrder order(ray);
  std::uint32_t node = 0;
  while (t0 < t1) {
    const BspLeaf& leaf = leaf_at(bsp, node, order, t0);
    ++mailbox.counts.cells_visited;
    const CellExit exit = exit_of(leaf.cell, order);
    double end = exit.t > t0 ? exit.t : t0;
    if (end > t1) end = t1;
    if (leaf.program_count > 0 && !visit(leaf, t0, end)) return false;
    if (exit.face < 0) break;
    node = leaf.neighbour[static_cast<std::size_t>(exit.face)];
    if (node == kNoNeighbour) break;
    t0 = end;
  }
  return true;
}

/// The first crossing of any object with t0 ≤ t < t1; at equal t the first object wins. The caller
/// has called mailbox.begin_ray() for this ray.
std::optional<Crossing> first_crossing(const Bsp& bsp, const Ray& ray, double t0, double t1,
                                       Mailbox& mailbox);

/// Lets a shadow ray's light through the surfaces crossed in [t0, t1): multiplies `light` by each
/// transparent one's transmit, in order of t, then of the objects. False when an opaque one ends
/// it.
bool pass_light(const Bsp& bsp, const Ray& ray, double t0, double t1, Mailbox& mailbox, Rgb& light);

}  // namespace graycube
