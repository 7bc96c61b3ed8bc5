// The intervals of a literal along several rays at once, one ray in each lane. Every lane goes
// through the very expressions of csg/sphere.hpp, csg/box.hpp, csg/half_space.hpp, csg/cylinder.hpp
// and csg/cone.cpp in doubles, so that it gets the bits that interval_of gives for its ray.
#if defined(GRAYCUBE_SPACE_PACKET_INTERVALS_INL) == defined(HWY_TARGET_TOGGLE)
#ifdef GRAYCUBE_SPACE_PACKET_INTERVALS_INL
#undef GRAYCUBE_SPACE_PACKET_INTERVALS_INL
#else
#define GRAYCUBE_SPACE_PACKET_INTERVALS_INL
#endif

#include <hwy/highway.h>

#include "crossings/object_crossings.hpp"

HWY_BEFORE_NAMESPACE();
namespace graycube {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Lanes = hn::CappedTag<double, 16>;
using Doubles = hn::Vec<Lanes>;
using LaneMask = hn::Mask<Lanes>;

struct LaneVec {
  Doubles x, y, z;
};

HWY_INLINE Doubles every(double v) { return hn::Set(Lanes(), v); }
HWY_INLINE LaneVec every(const Vec3& v) { return {every(v.x), every(v.y), every(v.z)}; }
HWY_INLINE Doubles lanes_dot(const LaneVec& a, const LaneVec& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

/// Rays side by side, with the reciprocals of their directions. All of these are finite: other rays
/// are traced singly.
struct LaneRays {
  LaneVec origin, direction, inverse;
};

struct LaneInterval {
  Doubles enter, leave;

  static HWY_INLINE LaneInterval whole() { return {every(-kInf), every(kInf)}; }
  // Written with comparisons, as csg::Interval is, so that a NaN goes the same way.
  HWY_INLINE void enter_after(Doubles t) { enter = hn::IfThenElse(hn::Gt(t, enter), t, enter); }
  HWY_INLINE void leave_before(Doubles t) { leave = hn::IfThenElse(hn::Lt(t, leave), t, leave); }
  HWY_INLINE void make_empty(LaneMask where) {
    enter = hn::IfThenElse(where, every(kInf), enter);
    leave = hn::IfThenElse(where, every(-kInf), leave);
  }
};

HWY_INLINE LaneInterval lanes_sphere(const LaneVec& origin, const LaneVec& direction,
                                     double radius2) {
  const Doubles dd = lanes_dot(direction, direction);
  const Doubles nearest = hn::Div(hn::Neg(lanes_dot(origin, direction)), dd);
  const LaneVec q{hn::Add(origin.x, hn::Mul(nearest, direction.x)),
                  hn::Add(origin.y, hn::Mul(nearest, direction.y)),
                  hn::Add(origin.z, hn::Mul(nearest, direction.z))};
  const Doubles h2 = hn::Sub(every(radius2), lanes_dot(q, q));
  const Doubles half = hn::Sqrt(hn::Div(h2, dd));
  LaneInterval i{hn::Sub(nearest, half), hn::Add(nearest, half)};
  i.make_empty(hn::Not(hn::Ge(h2, hn::Zero(Lanes()))));
  return i;
}

/// Clips to a slab that no lane is parallel to.
HWY_INLINE void clip_lanes_to_slab(LaneInterval& i, double lo, double hi, Doubles o,
                                   Doubles inverse) {
  const Doubles a = hn::Mul(hn::Sub(every(lo), o), inverse);
  const Doubles b = hn::Mul(hn::Sub(every(hi), o), inverse);
  const LaneMask upward = hn::Gt(inverse, hn::Zero(Lanes()));
  i.enter_after(hn::IfThenElse(upward, a, b));
  i.leave_before(hn::IfThenElse(upward, b, a));
}

/// Clips to any slab, like csg::clip_to_slab().
HWY_INLINE void clip_lanes_to_any_slab(LaneInterval& i, double lo, double hi, Doubles o,
                                       Doubles d) {
  const Doubles inverse = hn::Div(every(1.0), d);
  const LaneMask crosses = hn::IsFinite(inverse);
  LaneInterval clipped = i;
  clip_lanes_to_slab(clipped, lo, hi, o, inverse);
  const LaneMask apart = hn::Or(hn::Lt(o, every(lo)), hn::Gt(o, every(hi)));
  i.make_empty(hn::AndNot(crosses, apart));
  i.enter = hn::IfThenElse(crosses, clipped.enter, i.enter);
  i.leave = hn::IfThenElse(crosses, clipped.leave, i.leave);
}

/// Like csg::clip_to_half_space(), for each lane.
HWY_INLINE void clip_lanes_to_half_space(LaneInterval& i, double offset, Doubles o, Doubles d) {
  const Doubles inverse = hn::Div(every(1.0), d);
  const Doubles t = hn::Mul(hn::Sub(every(offset), o), inverse);
  const LaneMask crosses = hn::IsFinite(inverse);
  const LaneMask upward = hn::Gt(d, hn::Zero(Lanes()));
  const LaneMask leaves = hn::And(hn::And(crosses, upward), hn::Lt(t, i.leave));
  const LaneMask enters = hn::And(hn::AndNot(upward, crosses), hn::Gt(t, i.enter));
  i.leave = hn::IfThenElse(leaves, t, i.leave);
  i.enter = hn::IfThenElse(enters, t, i.enter);
  i.make_empty(hn::AndNot(crosses, hn::Gt(o, every(offset))));
}

HWY_INLINE LaneInterval lanes_half_space(double offset, Doubles o, Doubles d) {
  LaneInterval i = LaneInterval::whole();
  clip_lanes_to_half_space(i, offset, o, d);
  return i;
}

/// Ends early when the intervals of all lanes are empty.
HWY_INLINE LaneInterval lanes_polyhedron(std::span<const Plane> faces, const LaneRays& rays) {
  LaneInterval i = LaneInterval::whole();
  for (const Plane& f : faces) {
    const LaneVec n = every(f.normal);
    clip_lanes_to_half_space(i, f.offset, lanes_dot(n, rays.origin), lanes_dot(n, rays.direction));
    if (hn::AllFalse(Lanes(), hn::Le(i.enter, i.leave))) break;
  }
  return i;
}

HWY_INLINE LaneVec lanes_vector(const Affine& map, const LaneVec& v) {
  const auto row = [&](const std::array<double, 4>& m) {
    return hn::Add(hn::Add(hn::Mul(every(m[0]), v.x), hn::Mul(every(m[1]), v.y)),
                   hn::Mul(every(m[2]), v.z));
  };
  return {row(map.m[0]), row(map.m[1]), row(map.m[2])};
}
HWY_INLINE LaneVec lanes_point(const Affine& map, const LaneVec& p) {
  const LaneVec v = lanes_vector(map, p);
  return {hn::Add(v.x, every(map.m[0][3])), hn::Add(v.y, every(map.m[1][3])),
          hn::Add(v.z, every(map.m[2][3]))};
}

/// The part of each lane's line with x² + y² ≤ 1.
HWY_INLINE LaneInterval lanes_tube(const LaneVec& o, const LaneVec& d) {
  const Doubles dd = hn::Add(hn::Mul(d.x, d.x), hn::Mul(d.y, d.y));
  const Doubles nearest = hn::Div(hn::Neg(hn::Add(hn::Mul(o.x, d.x), hn::Mul(o.y, d.y))), dd);
  const LaneMask slants = hn::IsFinite(nearest);
  const Doubles x = hn::Add(o.x, hn::Mul(nearest, d.x));
  const Doubles y = hn::Add(o.y, hn::Mul(nearest, d.y));
  const Doubles h2 = hn::Sub(every(1.0), hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
  const Doubles half = hn::Sqrt(hn::Div(h2, dd));
  LaneInterval i{hn::Sub(nearest, half), hn::Add(nearest, half)};
  i.make_empty(hn::Not(hn::Ge(h2, hn::Zero(Lanes()))));
  // Lines parallel to the axis.
  i.enter = hn::IfThenElse(slants, i.enter, every(-kInf));
  i.leave = hn::IfThenElse(slants, i.leave, every(kInf));
  const Doubles axis_distance2 = hn::Add(hn::Mul(o.x, o.x), hn::Mul(o.y, o.y));
  i.make_empty(hn::AndNot(slants, hn::Gt(axis_distance2, every(1.0))));
  return i;
}

HWY_INLINE void clip_lanes_to_caps(LaneInterval& i, const Primitive& p, const LaneRays& rays) {
  const LaneVec n = every(csg::cap_normal(p));
  clip_lanes_to_any_slab(i, csg::lower_cap(p), csg::upper_cap(p), lanes_dot(n, rays.origin),
                         lanes_dot(n, rays.direction));
}

HWY_INLINE LaneInterval lanes_cylinder(const Primitive& p, const LaneRays& rays) {
  LaneInterval i =
      lanes_tube(lanes_point(p.to_local, rays.origin), lanes_vector(p.to_local, rays.direction));
  clip_lanes_to_caps(i, p, rays);
  return i;
}

HWY_INLINE LaneInterval lanes_parallelepiped(const Primitive& p, const LaneRays& rays) {
  const LaneVec o = lanes_point(p.to_local, rays.origin);
  const LaneVec d = lanes_vector(p.to_local, rays.direction);
  LaneInterval i = LaneInterval::whole();
  const Vec3 lo = csg::box_lo(p), hi = csg::box_hi(p);
  clip_lanes_to_any_slab(i, lo.x, hi.x, o.x, d.x);
  clip_lanes_to_any_slab(i, lo.y, hi.y, o.y, d.y);
  clip_lanes_to_any_slab(i, lo.z, hi.z, o.z, d.z);
  return i;
}

HWY_INLINE Doubles lanes_fmin(Doubles a, Doubles b) {
  return hn::IfThenElse(hn::IsNaN(b), a, hn::IfThenElse(hn::Lt(a, b), a, b));
}
HWY_INLINE Doubles lanes_fmax(Doubles a, Doubles b) {
  return hn::IfThenElse(hn::IsNaN(b), a, hn::IfThenElse(hn::Gt(a, b), a, b));
}

/// The part of each lane's line with w + t·wd ≥ 0, like positive_nappe() of csg/cone.cpp.
HWY_INLINE LaneInterval lanes_positive_nappe(Doubles w, Doubles wd) {
  const Doubles zero = hn::Zero(Lanes());
  const Doubles apex = hn::Div(hn::Neg(w), wd);
  const LaneMask level = hn::Eq(wd, zero);
  const LaneMask upward = hn::Gt(wd, zero);
  LaneInterval i{hn::IfThenElse(upward, apex, every(-kInf)),
                 hn::IfThenElse(upward, every(kInf), apex)};
  i.enter = hn::IfThenElse(level, every(-kInf), i.enter);
  i.leave = hn::IfThenElse(level, every(kInf), i.leave);
  i.make_empty(hn::AndNot(hn::Ge(w, zero), level));
  return i;
}

HWY_INLINE LaneInterval choose(LaneMask mask, const LaneInterval& yes, const LaneInterval& no) {
  return {hn::IfThenElse(mask, yes.enter, no.enter), hn::IfThenElse(mask, yes.leave, no.leave)};
}

/// Like csg::cone_interval(), every branch of which is computed for all lanes.
HWY_INLINE LaneInterval lanes_double_cone(double k, const LaneVec& o, const LaneVec& d) {
  const Lanes lanes;
  const Doubles zero = hn::Zero(lanes);
  const LaneVec from_middle{o.x, o.y, hn::Sub(o.z, every(0.5))};
  const Doubles nearest = hn::Div(hn::Neg(lanes_dot(from_middle, d)), lanes_dot(d, d));
  const LaneVec q{hn::Add(o.x, hn::Mul(nearest, d.x)), hn::Add(o.y, hn::Mul(nearest, d.y)),
                  hn::Add(o.z, hn::Mul(nearest, d.z))};
  const Doubles w = hn::Add(every(1.0), hn::Mul(every(k), q.z));
  const Doubles wd = hn::Mul(every(k), d.z);
  const auto form = [](Doubles x0, Doubles x1, Doubles y0, Doubles y1, Doubles w0, Doubles w1) {
    return hn::Sub(hn::Add(hn::Mul(x0, x1), hn::Mul(y0, y1)), hn::Mul(w0, w1));
  };
  const Doubles a = form(d.x, d.x, d.y, d.y, wd, wd);
  const Doubles b = form(q.x, d.x, q.y, d.y, w, wd);
  const Doubles c = form(q.x, q.x, q.y, q.y, w, w);
  const Doubles discriminant = hn::Sub(hn::Mul(b, b), hn::Mul(a, c));
  const Doubles root = hn::Sqrt(discriminant);
  const Doubles s =
      hn::IfThenElse(hn::Ge(b, zero), hn::Neg(hn::Add(b, root)), hn::Add(hn::Neg(b), root));
  const Doubles r0 = hn::Div(s, a);
  const Doubles r1 = hn::Div(c, s);
  const LaneMask opens = hn::Gt(a, zero);
  const LaneInterval between{lanes_fmin(r0, r1), lanes_fmax(r0, r1)};
  LaneInterval i = between;
  if (!hn::AllTrue(lanes, opens)) {
    const LaneInterval above{between.leave, every(kInf)}, below{every(-kInf), between.enter};
    const LaneInterval before{every(-kInf), r1}, behind{r1, every(kInf)};
    const LaneInterval parallel = choose(hn::Gt(b, zero), before, behind);
    i = choose(opens, i, choose(hn::Lt(a, zero), choose(hn::Gt(wd, zero), above, below), parallel));
  }
  // Tangents, and lines through the apex.
  const LaneMask misses = hn::Lt(discriminant, zero);
  const LaneMask touches = hn::AndNot(misses, hn::Eq(s, zero));
  if (!hn::AllFalse(lanes, hn::Or(misses, touches))) {
    LaneInterval nappe = lanes_positive_nappe(w, wd);
    LaneInterval touching = choose(opens, {zero, zero}, nappe);
    touching.make_empty(hn::AndNot(opens, hn::Not(hn::Le(c, zero))));
    nappe.make_empty(opens);
    i = choose(misses, nappe, choose(touches, touching, i));
  }
  return {hn::Add(i.enter, nearest), hn::Add(i.leave, nearest)};
}

HWY_INLINE LaneInterval lanes_cone(const Primitive& p, const LaneRays& rays) {
  LaneInterval i = lanes_double_cone(csg::cone_slope(p), lanes_point(p.to_local, rays.origin),
                                     lanes_vector(p.to_local, rays.direction));
  i.make_empty(hn::Not(hn::Le(i.enter, i.leave)));
  clip_lanes_to_caps(i, p, rays);
  return i;
}

/// The part of each lane's line inside the literal's primitive; the kind is one of
/// has_lane_interval.
HWY_INLINE LaneInterval lane_interval_of(const Literal& literal, const Model& model,
                                         const LaneRays& rays) {
  const auto& v = literal.v;
  LaneInterval i = LaneInterval::whole();
  switch (literal.kind) {
    case PrimitiveKind::kSphere: {
      const LaneVec c = every(csg::sphere_center(v));
      const LaneVec o{hn::Sub(rays.origin.x, c.x), hn::Sub(rays.origin.y, c.y),
                      hn::Sub(rays.origin.z, c.z)};
      i = lanes_sphere(o, rays.direction, csg::squared_radius(v));
      break;
    }
    case PrimitiveKind::kBox:
      clip_lanes_to_slab(i, csg::box_side(v, 0, 0), csg::box_side(v, 1, 0), rays.origin.x,
                         rays.inverse.x);
      clip_lanes_to_slab(i, csg::box_side(v, 0, 1), csg::box_side(v, 1, 1), rays.origin.y,
                         rays.inverse.y);
      clip_lanes_to_slab(i, csg::box_side(v, 0, 2), csg::box_side(v, 1, 2), rays.origin.z,
                         rays.inverse.z);
      break;
    case PrimitiveKind::kHalfSpace: {
      const Plane f = csg::half_space_plane(v);
      const LaneVec n = every(f.normal);
      i = lanes_half_space(f.offset, lanes_dot(n, rays.origin), lanes_dot(n, rays.direction));
      break;
    }
    case PrimitiveKind::kCylinder:
      i = lanes_cylinder(model.primitives[literal.primitive], rays);
      break;
    case PrimitiveKind::kEllipsoid: {
      const Affine& map = model.primitives[literal.primitive].to_local;
      i = lanes_sphere(lanes_point(map, rays.origin), lanes_vector(map, rays.direction), 1.0);
      break;
    }
    case PrimitiveKind::kCone: i = lanes_cone(model.primitives[literal.primitive], rays); break;
    case PrimitiveKind::kPolyhedron: {
      const Primitive& p = model.primitives[literal.primitive];
      i = lanes_polyhedron({model.planes.data() + p.first_plane, p.plane_count}, rays);
      break;
    }
    case PrimitiveKind::kParallelepiped:
      i = lanes_parallelepiped(model.primitives[literal.primitive], rays);
      break;
    // A line may be inside of these twice or more: LaneItem solves them lane by lane.
    case PrimitiveKind::kTorus:
    case PrimitiveKind::kEllipticCone:
    case PrimitiveKind::kEllipticTorus:
    case PrimitiveKind::kQuadric:
    case PrimitiveKind::kMesh:
    case PrimitiveKind::kLathe:
    case PrimitiveKind::kSweep: break;
  }
  // −0 is made +0.
  i.enter = hn::Add(i.enter, hn::Zero(Lanes()));
  i.leave = hn::Add(i.leave, hn::Zero(Lanes()));
  return i;
}

}  // namespace HWY_NAMESPACE
}  // namespace graycube
HWY_AFTER_NAMESPACE();

#endif
