// Space tracing (Kaplan 1985): space is cut in halves, across x, y and z in turn, until little is
// left in a cell. Cells aren't linked: to go on, a ray descends from the root to the cell that it
// is in at the parameter it has reached.
#pragma once

#include <vector>

#include "crossings/bsp.hpp"
#include "subdivisions/bounded_space.hpp"
#include "subdivisions/halving.hpp"

namespace graycube {

class KaplanCells {
 public:
  explicit KaplanCells(const Model& model);

  /// As pieces.hpp says.
  template <typename Visit>
  bool walk(const Ray& ray, double t0, double t1, Mailbox& mailbox, Visit&& visit) const {
    return space_.walk(
        ray, t0, t1, mailbox,
        [&](const PlaneOrder& order, double t) { return locate(order, t, mailbox.counts); }, visit);
  }

  const Model& model() const { return space_.programs().model(); }
  std::size_t cell_count() const { return leaves_.size(); }
  std::size_t memory_bytes() const;
  /// Inner nodes, and leaves whose `child` is the number of a leaf region.
  const std::vector<BspNode>& nodes() const { return nodes_; }

 private:
  KaplanCells(const Model& model, CellContent inside);
  template <typename Add>
  void cut(const HalvedCell& cell, Add&& add);

  /// The planes passed on the way down that the ray is still to cross bound its stay.
  LocatedCell locate(const PlaneOrder& order, double t, WalkCounts& counts) const {
    double exit = kInf;
    for (std::uint32_t node = 0;;) {
      const BspNode& n = nodes_[node];
      if (n.axis == BspNode::kLeafAxis) return {leaves_[n.child], exit};
      ++counts.nodes_descended;
      bool above;
      if (order.sense(n.axis) == 0) {
        above = order.origin(n.axis) >= n.split;
      } else {
        const double crossed = order.parameter(n.axis, n.split);
        above = (t >= crossed) == (order.sense(n.axis) > 0);
        if (t < crossed && crossed < exit) exit = crossed;
      }
      node = n.child + (above ? 1u : 0u);
    }
  }

  BoundedSpace space_;
  std::vector<BspNode> nodes_;
  std::vector<ProgramRange> leaves_;
};

}  // namespace graycube
