// The plain tracer's shapes: where a line is inside, normals, bounds.
#pragma once

#include <array>

#include "bench/plain/plain_solids.hpp"

namespace graycube::plain {

struct Interval {
  double enter = -kInf, leave = kInf;

  void clip(double from, double to) {
    if (from > enter) enter = from;
    if (to < leave) leave = to;
  }
  bool is_empty() const { return !(enter < leave); }
};

/// A ring's line has up to two.
struct Intervals {
  std::array<Interval, 2> list;
  int count = 0;

  void add(const Interval& i) {
    if (!i.is_empty()) list[static_cast<std::size_t>(count++)] = i;
  }
};

Intervals intervals(const Ball& b, const Line& line);
Intervals intervals(const Block& b, const Line& line);
Intervals intervals(const Tube& t, const Line& line);
Intervals intervals(const Ring& r, const Line& line);
Intervals intervals(const Planes& p, const Line& line);

/// Outwards, at a point of the surface; not unit.
Vec3 normal_at(const Shape& shape, const Vec3& point);

/// Bounds of the shape's image; infinite for planes.
Aabb bounds_of(const Shape& shape, const Affine& map);

/// The shape that a leaf of a scene stands for, and what its own map adds to the node's.
struct PlainLeaf {
  Shape shape;
  std::optional<Affine> map;
};
PlainLeaf plain_leaf(const SphereShape& s);
PlainLeaf plain_leaf(const BoxShape& s);
PlainLeaf plain_leaf(const CylinderShape& s);
PlainLeaf plain_leaf(const ConeShape& s);
PlainLeaf plain_leaf(const TorusShape& s);
PlainLeaf plain_leaf(const HalfSpaceShape& s);
PlainLeaf plain_leaf(const EllipsoidShape& s);
PlainLeaf plain_leaf(const PolyhedronShape& s);

}  // namespace graycube::plain
