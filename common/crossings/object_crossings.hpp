// Finds crossings of one object along a whole ray, without a subdivision underneath, for the items
// of the surface tree. They are the same, bit for bit, as those that crossings.hpp finds cell by
// cell.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "crossings/crossings.hpp"
#include "crossings/mailbox.hpp"
#include "crossings/masked_program.hpp"
#include "csg/kinds.hpp"
#include "csg/model.hpp"

namespace graycube {

/// One leaf of a program with its primitive's slots, in one cache line. For a kind that needs more
/// and looks its primitive up, `v` holds grown bounds as floats: lower corner, upper corner.
struct alignas(64) Literal {
  Slots v{};
  std::uint32_t primitive = 0;
  PrimitiveKind kind = PrimitiveKind::kSphere;
  bool is_inverted = false;
};
static_assert(sizeof(Literal) == 64);

/// A ray with the reciprocals of its direction, which every box test needs.
struct PreparedRay {
  explicit PreparedRay(const Ray& r) : ray(r) {
    for (int a = 0; a < 3; ++a) inverse[a] = 1.0 / r.direction[a];
  }
  PreparedRay(const Ray& r, const Vec3& reciprocals) : ray(r), inverse(reciprocals) {}
  Ray ray;
  Vec3 inverse;
};

namespace crossings {

/// Like csg::clip_to_slab(), with the reciprocal given.
inline void clip_to_prepared_slab(csg::Interval& i, double lo, double hi, double o,
                                  double inverse) {
  if (!std::isfinite(inverse)) [[unlikely]] {
    if (o < lo || o > hi) i.make_empty();
    return;
  }
  const double a = csg::plane_parameter(lo, o, inverse);
  const double b = csg::plane_parameter(hi, o, inverse);
  if (inverse > 0) {
    i.clip(a, b);
  } else {
    i.clip(b, a);
  }
}

/// An interval of a line. Unlike csg::Interval it isn't initialized, since it stands in arrays of
/// which mostly only the first few elements are used.
struct Ends {
  double enter, leave;
};

/// The part of the line inside the literal's primitive. False when it has more than one interval;
/// then the caller takes the general way.
inline bool interval_of(const Literal& literal, const Model& model, const PreparedRay& ray,
                        Ends& out) {
  const auto& v = literal.v;
  csg::Interval i;
  switch (literal.kind) {
    case PrimitiveKind::kSphere:
      i = csg::sphere_interval(ray.ray.origin - csg::sphere_center(v), ray.ray.direction,
                               csg::squared_radius(v));
      break;
    case PrimitiveKind::kBox:
      clip_to_prepared_slab(i, csg::box_side(v, 0, 0), csg::box_side(v, 1, 0), ray.ray.origin.x,
                            ray.inverse.x);
      clip_to_prepared_slab(i, csg::box_side(v, 0, 1), csg::box_side(v, 1, 1), ray.ray.origin.y,
                            ray.inverse.y);
      clip_to_prepared_slab(i, csg::box_side(v, 0, 2), csg::box_side(v, 1, 2), ray.ray.origin.z,
                            ray.inverse.z);
      break;
    case PrimitiveKind::kHalfSpace: {
      const Plane f = csg::half_space_plane(v);
      csg::clip_to_half_space(i, f.offset, dot(f.normal, ray.ray.origin),
                              dot(f.normal, ray.ray.direction));
      break;
    }
    case PrimitiveKind::kCylinder: {
      const Primitive& p = model.primitives[literal.primitive];
      i = csg::tube_interval(p.to_local.point(ray.ray.origin),
                             p.to_local.vector(ray.ray.direction));
      csg::clip_to_caps(i, p, ray.ray);
      break;
    }
    case PrimitiveKind::kMesh:
    case PrimitiveKind::kLathe:
    case PrimitiveKind::kSweep: return false;
    default: {
      const Spans s = spans_along(model.primitives[literal.primitive], model.data(), ray.ray);
      if (s.count > 1) return false;
      if (s.count == 0) {
        i.make_empty();
      } else {
        i = {s.interval[0].enter, s.interval[0].leave};
      }
    }
  }
  out.enter = i.enter + 0.0;
  out.leave = i.leave + 0.0;
  return true;
}

/// Kinds whose intervals packet_intervals-inl.hpp computes.
inline bool has_lane_interval(PrimitiveKind kind) {
  constexpr std::uint32_t kTwice = csg::kinds_with(&csg::KindTraits::has_two_intervals);
  return !csg::is_among(kind, kTwice);
}
/// Kinds that a line may be inside of twice.
inline bool may_have_two_intervals(PrimitiveKind kind) { return !has_lane_interval(kind); }

/// Kinds that a line may be inside of any number of times.
inline bool may_have_many_intervals(PrimitiveKind kind) {
  constexpr std::uint32_t kMany = csg::kinds_with(&csg::KindTraits::has_many_intervals);
  return csg::is_among(kind, kMany);
}

/// Kinds whose literals hold bounds, since solving them looks their primitive up.
inline bool has_bounds(PrimitiveKind kind) {
  constexpr std::uint32_t kAllSlots = csg::kinds_with(&csg::KindTraits::is_all_slots);
  return !csg::is_among(kind, kAllSlots);
}

/// False only when the line surely misses the literal's bounds, or is in them only before t0 or
/// after t1. For kinds with has_bounds().
inline bool may_meet(const Literal& literal, const PreparedRay& ray, double t0, double t1) {
  const double error = 1e-12 * max_abs(ray.ray.origin);
  for (int a = 0; a < 3; ++a) {
    const auto axis = static_cast<std::size_t>(a);
    const double inverse = ray.inverse[a];
    const double lo = (csg::box_side(literal.v, 0, axis) - error - ray.ray.origin[a]) * inverse;
    const double hi = (csg::box_side(literal.v, 1, axis) + error - ray.ray.origin[a]) * inverse;
    // Written so that a NaN, which a line in a plane of the bounds gives, is ignored.
    const double enter = inverse > 0 ? lo : hi;
    const double leave = inverse > 0 ? hi : lo;
    if (enter > t0) t0 = enter;
    if (leave < t1) t1 = leave;
  }
  return !(t0 > t1 + 1e-12 * std::fabs(t1));
}

/// Calls add(enter, leave) for the literal's intervals along the line, of which there are
/// two at most.
template <typename Add>
void each_interval(const Literal& literal, const Model& model, const PreparedRay& ray, Add&& add) {
  Ends ends;
  if (!may_have_two_intervals(literal.kind)) {
    interval_of(literal, model, ray, ends);
    return add(ends.enter, ends.leave);
  }
  const Spans spans = spans_along(model.primitives[literal.primitive], model.data(), ray.ray);
  for (int i = 0; i < spans.count; ++i) {
    const auto& s = spans.interval[static_cast<std::size_t>(i)];
    add(s.enter, s.leave);
  }
}

/// The primitive of the first literal whose own membership changes at t; interval(i) gives literal
/// i's.
template <typename IntervalOf>
std::uint32_t changed_literal(std::span<const Literal> literals, IntervalOf&& interval, double t) {
  for (std::size_t i = 0; i < literals.size(); ++i) {
    const Ends own = interval(i);
    // An empty interval may have ends, the wrong way round; they change nothing.
    if (own.enter < own.leave && (own.enter == t || own.leave == t)) return literals[i].primitive;
  }
  return literals.front().primitive;
}

/// Membership of a conjunction along the line, as half-open intervals [E, L): right after the
/// crossings at t, a literal holds where enter ≤ t < leave. So the conjunction is the upright
/// literals' common interval without the inverted ones', and its ends are its crossings.
///
/// Calls visit(t, entering) for the crossings with t0 ≤ t < t1, in order, until visit returns
/// false; then returns false.
template <typename Visit>
bool conjunction_ends(std::span<const Ends> removed, double from, double to, double t0, double t1,
                      Visit&& visit) {
  double at = from;
  while (at < to) {
    for (bool moved = true; moved;) {
      moved = false;
      for (const Ends& r : removed) {
        if (r.enter <= at && at < r.leave) {
          at = r.leave;
          moved = true;
        }
      }
    }
    if (!(at < to) || at >= t1) return true;
    if (at >= t0 && at > -kInf && !visit(at, true)) return false;
    double end = to;
    for (const Ends& r : removed) {
      if (r.enter > at && r.enter < end && r.enter < r.leave) end = r.enter;
    }
    if (end >= t1) return true;
    if (end >= t0 && !visit(end, false)) return false;
    at = end;
    if (end == to) return true;
  }
  return true;
}

}  // namespace crossings

/// An object, or what is left of it in a cell, as the surface tree holds it.
struct SurfaceItem {
  static constexpr std::uint32_t kAllSpace = 0xFFFFFFFFu;
  static constexpr std::uint32_t kFlat = 0xFFFFFFFFu;

  std::uint32_t object = 0;
  std::uint32_t first_literal = 0;
  std::uint32_t literal_count = 0;
  /// Index into SurfaceTree::cells; kAllSpace when the whole object is here.
  std::uint32_t cell = kAllSpace;
  /// First of the nodes of a general program; kFlat for a conjunction or its complement.
  std::uint32_t first_node = kFlat;
  std::uint32_t node_count = 0;
  /// First of the operations of a general program that is small (for MaskedProgram); there are
  /// node_count − literal_count of them.
  std::uint32_t first_operation = 0;
  /// The literals are those of the complement, which is a conjunction: entering and leaving swap.
  bool is_complement = false;
  /// No crossing of it lets light through.
  bool is_opaque = true;
  /// It has few literals, none with many intervals: it is solved without taking memory, several
  /// rays at once.
  bool is_small = false;
  /// Any line is inside each literal's primitive in one interval at most.
  bool is_simple = false;

  /// The item is one mesh, uncut.
  bool is_mesh = false;

  bool is_flat() const { return first_node == kFlat; }
};

}  // namespace graycube
