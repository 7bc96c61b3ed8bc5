// An octree (Glassner 1984): a cube around the finite primitives, cut in halves across all three
// axes at once until little is left in a cell. To go on, a ray finds the name of the cell that it
// is in at the parameter it has reached, digit by digit, and by its name the cell.
#pragma once

#include "subdivisions/bounded_space.hpp"
#include "subdivisions/halving.hpp"
#include "subdivisions/name_table.hpp"

namespace graycube {

class OctreeCells {
 public:
  explicit OctreeCells(const Model& model);

  /// As pieces.hpp says.
  template <typename Visit>
  bool walk(const Ray& ray, double t0, double t1, Mailbox& mailbox, Visit&& visit) const {
    return space_.walk(
        ray, t0, t1, mailbox,
        [&](const PlaneOrder& order, double t) { return locate(order, t, mailbox.counts); }, visit);
  }

  const Model& model() const { return space_.programs().model(); }
  std::size_t cell_count() const { return leaf_count_; }
  std::size_t memory_bytes() const { return space_.memory_bytes() + table_.memory_bytes(); }
  const Aabb& cube() const { return space_.box(); }

 private:
  OctreeCells(const Model& model, CellContent inside);
  template <typename Add>
  void cut(const HalvedCell& cell, Add&& add);
  static Aabb part_box(const Aabb& cell, unsigned part);

  /// The planes passed on the way down that the ray is still to cross bound its stay.
  LocatedCell locate(const PlaneOrder& order, double t, WalkCounts& counts) const {
    double exit = kInf;
    Aabb cell = space_.box();
    for (CellName name = kRootName;;) {
      const NameTable::Entry* found = table_.find(name);
      if (found == nullptr) return {{}, exit};
      if (!found->is_cut) return {found->programs, exit};
      ++counts.nodes_descended;
      unsigned part = 0;
      for (int a = 0; a < 3; ++a) {
        const double middle = 0.5 * (cell.lo[a] + cell.hi[a]);
        const double crossed = order.parameter(a, middle);
        const bool above = order.is_above(a, middle, t);
        if (order.sense(a) != 0 && t < crossed && crossed < exit) exit = crossed;
        (above ? cell.lo : cell.hi)[a] = middle;
        if (above) part |= 1u << a;
      }
      name = part_of(name, part);
    }
  }

  BoundedSpace space_;
  NameTable table_;
  std::size_t leaf_count_ = 0;
};

}  // namespace graycube
