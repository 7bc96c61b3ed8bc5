// All of space as a box around the finite primitives, which a subdivision cuts into cells, and what
// is around it: one region, in which unbounded primitives stand alone.
#pragma once

#include "crossings/cell_programs.hpp"
#include "subdivisions/pieces.hpp"
#include "subdivisions/plane_order.hpp"

namespace graycube {

/// The half-open part of a ray's [t0, t1) in a box; empty when not from < to.
struct BoxPiece {
  double from, to;
};
inline BoxPiece piece_in(const Aabb& box, const PlaneOrder& order, double t0, double t1) {
  for (int a = 0; a < 3; ++a) {
    const int sense = order.sense(a);
    if (sense == 0) {
      if (order.origin(a) < box.lo[a] || order.origin(a) >= box.hi[a]) return {t1, t1};
      continue;
    }
    const double enter = order.parameter(a, sense > 0 ? box.lo[a] : box.hi[a]);
    const double leave = order.parameter(a, sense > 0 ? box.hi[a] : box.lo[a]);
    if (enter > t0) t0 = enter;
    if (leave < t1) t1 = leave;
  }
  return {t0, t1};
}

/// Holds the programs of the region around; those of the cells are added by who cuts the box.
class BoundedSpace {
 public:
  /// `as_cube`: the box is a cube. Its content is in `inside`, for the caller to cut.
  BoundedSpace(const Model& model, bool as_cube, CellContent& inside);

  const Aabb& box() const { return box_; }
  const CellPrograms& programs() const { return programs_; }
  ProgramRange add(const CellContent& content) { return programs_.add(content); }
  std::size_t memory_bytes() const { return programs_.memory_bytes(); }

  /// Walks along a ray, as pieces.hpp says. For the cells in the box, `locate(order, t)` finds
  /// the one in which the ray is at t: its `programs`, and the parameter `exit` > t, perhaps
  /// infinite, before which the ray doesn't leave it unless it leaves the box.
  template <typename Locate, typename Visit>
  bool walk(const Ray& ray, double t0, double t1, Mailbox& mailbox, Locate&& locate,
            Visit&& visit) const {
    const PlaneOrder order(ray);
    const auto look = [&](ProgramRange range, double from, double to) {
      ++mailbox.counts.cells_visited;
      return range.count == 0 || visit(CellPiece(programs_, range, ray, mailbox), from, to);
    };
    const auto [enter, leave] = piece_in(box_, order, t0, t1);
    if (!(enter < leave)) return look(around_, t0, t1);
    if (t0 < enter && !look(around_, t0, enter)) return false;
    for (double t = enter; t < leave;) {
      const auto cell = locate(order, t);
      const double end = cell.exit < leave ? cell.exit : leave;
      if (!look(cell.programs, t, end)) return false;
      t = end;
    }
    return !(leave < t1) || look(around_, leave, t1);
  }

 private:
  Aabb box_;
  CellPrograms programs_;
  ProgramRange around_;
};

/// A leaf region found for a parameter of a ray.
struct LocatedCell {
  ProgramRange programs;
  double exit = kInf;
};

}  // namespace graycube
