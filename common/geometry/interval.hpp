// Intervals of a line, and clipping them by planes.
#pragma once

#include <cmath>

#include "geometry/infinity.hpp"
#include "geometry/spans.hpp"

namespace graycube::csg {

/// One closed interval of a line; empty when enter > leave.
struct Interval {
  double enter = -kInf;
  double leave = kInf;

  bool is_empty() const { return !(enter <= leave); }
  void clip(double from, double to) {
    if (from > enter) enter = from;
    if (to < leave) leave = to;
  }
  void make_empty() {
    enter = kInf;
    leave = -kInf;
  }
};

/// The interval as spans; −0 becomes +0.
inline Spans spans_of(const Interval& i) {
  Spans s;
  if (!i.is_empty()) s.add(i.enter + 0.0, i.leave + 0.0);
  return s;
}

/// The parameter at which the line o + t d crosses the plane n·p = offset, given n·o and 1/(n·d).
/// Every plane of every kind of primitive and of the subdivision uses this one expression, so that
/// coincident faces have bitwise equal parameters.
inline double plane_parameter(double offset, double origin, double inverse) {
  return (offset - origin) * inverse;
}

/// Clips to lo ≤ o + t d ≤ hi. A line parallel to the slab stays whole when it touches it.
inline void clip_to_slab(Interval& i, double lo, double hi, double o, double d) {
  const double inverse = 1.0 / d;
  if (!std::isfinite(inverse)) {
    if (o < lo || o > hi) i.make_empty();
    return;
  }
  const double a = plane_parameter(lo, o, inverse);
  const double b = plane_parameter(hi, o, inverse);
  if (d > 0) {
    i.clip(a, b);
  } else {
    i.clip(b, a);
  }
}

/// Clips to o + t d ≤ hi.
inline void clip_to_half_space(Interval& i, double hi, double o, double d) {
  const double inverse = 1.0 / d;
  if (!std::isfinite(inverse)) {
    if (o > hi) i.make_empty();
    return;
  }
  const double t = plane_parameter(hi, o, inverse);
  if (d > 0) {
    i.clip(-kInf, t);
  } else {
    i.clip(t, kInf);
  }
}

/// Whether a slab's face has exactly this parameter. Used to find the face that a root came from.
inline bool is_on_plane(double offset, double o, double d, double t) {
  const double inverse = 1.0 / d;
  return std::isfinite(inverse) && plane_parameter(offset, o, inverse) == t;
}

/// Distance from zero to the interval [lo, hi].
inline double distance_to_zero(double lo, double hi) { return lo > 0 ? lo : hi < 0 ? -hi : 0.0; }

}  // namespace graycube::csg
