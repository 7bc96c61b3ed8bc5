// Finds where a quartic is negative on a piece of a line. It is never expanded: sums of products of
// quadratics keep their digits. Extremes lie between the zeros of the second derivative, roots
// between extremes, and membership is evaluated, never counted.
#pragma once

#include <array>
#include <cmath>

#include "csg/roots.hpp"

namespace graycube::csg {

/// More than enough: each round at least halves the bracket or converges quadratically.
inline constexpr int kMaxRootRounds = 100;

/// The root of `f` in [lo, hi], where f(lo) and f(hi) have opposite signs: Newton, kept in a
/// shrinking bracket, until steps are no longer than `enough`; 0: until the last bit settles.
template <typename F, typename Derivative>
double bracketed_root(F&& f, Derivative&& derivative, double lo, double hi, double enough = 0) {
  const bool rises = f(lo) < 0;
  double s = 0.5 * (lo + hi);
  for (int round = 0; round < kMaxRootRounds; ++round) {
    const double value = f(s);
    if (value == 0) return s;
    if ((value < 0) == rises) {
      lo = s;
    } else {
      hi = s;
    }
    double next = s - value / derivative(s);
    if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
    if (std::fabs(next - s) <= enough || !(lo < next && next < hi)) return next;
    s = next;
  }
  return s;
}

/// A root near which `f` changes its sign in [lo, hi], the same to the bit for every
/// interval: f is evaluated on a fixed grid around the root, and the search begins anew in
/// the step of the grid in which the sign changes. Intervals matter only by the roots that
/// they hold.
template <typename F, typename Derivative>
double settled_root(F&& f, Derivative&& derivative, double lo, double hi) {
  constexpr double kStep = 0x1p-36;
  // Beyond this a step of the grid holds too few doubles.
  constexpr double kFarthest = 0x1p+12;
  const double s = bracketed_root(f, derivative, lo, hi, kStep / 8);
  if (!(std::fabs(s) < kFarthest)) return bracketed_root(f, derivative, lo, hi);
  const double below = std::floor(s / kStep) * kStep;
  const bool is_negative = f(below) < 0;
  if ((f(below + kStep) < 0) != is_negative)
    return bracketed_root(f, derivative, below, below + kStep);
  if ((f(below - kStep) < 0) != is_negative)
    return bracketed_root(f, derivative, below - kStep, below);
  // No sign changes in the grid's steps nearby: f rather touches zero than crosses it.
  return bracketed_root(f, derivative, lo, hi);
}

/// Sorted points that cut an interval into pieces on which a function is monotonic, ends included.
template <int N>
struct Knots {
  std::array<double, N> at{};
  int count = 0;
  void add(double s) {
    if (count == 0 || s > at[static_cast<std::size_t>(count - 1)])
      at[static_cast<std::size_t>(count++)] = s;
  }
};

/// a + b s + c s².
struct Quadratic {
  double a = 0, b = 0, c = 0;

  double at(double s) const { return a + s * (b + s * c); }
  double slope(double s) const { return b + 2 * c * s; }
};

/// The product of two linear functions a0 + a1 s and b0 + b1 s.
inline Quadratic product(double a0, double a1, double b0, double b1) {
  return {a0 * b0, a0 * b1 + a1 * b0, a1 * b1};
}

/// A sum of N products of quadratics.
template <std::size_t N>
struct ProductQuartic {
  struct Term {
    double sign;
    Quadratic p, q;
  };
  std::array<Term, N> terms;

  double f(double s) const {
    double sum = 0;
    for (const Term& t : terms) sum += t.sign * (t.p.at(s) * t.q.at(s));
    return sum;
  }
  double df(double s) const {
    double sum = 0;
    for (const Term& t : terms)
      sum += t.sign * (t.p.slope(s) * t.q.at(s) + t.p.at(s) * t.q.slope(s));
    return sum;
  }
  double ddf(double s) const {
    double sum = 0;
    for (const Term& t : terms) {
      sum += t.sign *
             (2 * t.p.c * t.q.at(s) + 2 * t.p.slope(s) * t.q.slope(s) + 2 * t.p.at(s) * t.q.c);
    }
    return sum;
  }
  /// Adds the zeros of f″ in [lo, hi], in order.
  void add_inflections(double lo, double hi, Knots<4>& knots) const {
    double c4 = 0, c3 = 0, c2 = 0;
    for (const Term& t : terms) {
      c4 += t.sign * t.p.c * t.q.c;
      c3 += t.sign * (t.p.c * t.q.b + t.p.b * t.q.c);
      c2 += t.sign * (t.p.c * t.q.a + t.p.b * t.q.b + t.p.a * t.q.c);
    }
    // 12 c4 s² + 6 c3 s + 2 c2.
    const double a = 6 * c4, b = 1.5 * c3, c = c2;
    const double discriminant = b * b - a * c;
    if (!(discriminant > 0)) return;
    const double w = b >= 0 ? -(b + std::sqrt(discriminant)) : -b + std::sqrt(discriminant);
    const double r0 = w / a, r1 = c / w;
    for (const double s : {std::fmin(r0, r1), std::fmax(r0, r1)}) {
      if (s > lo && s < hi) knots.add(s);
    }
  }
};

/// x² + y² − w²; what ProductQuartic computes, bit for bit, in half the operations: doubling is
/// exact.
struct SquaresQuartic {
  Quadratic x, y, w;

  double f(double s) const {
    const double vx = x.at(s), vy = y.at(s), vw = w.at(s);
    return vx * vx + vy * vy - vw * vw;
  }
  double df(double s) const {
    return 2 * (x.slope(s) * x.at(s) + y.slope(s) * y.at(s) - w.slope(s) * w.at(s));
  }
  double ddf(double s) const {
    const auto half = [s](const Quadratic& q) {
      const double outer = q.c * q.at(s), slope = q.slope(s);
      return outer + slope * slope + outer;
    };
    return 2 * (half(x) + half(y) - half(w));
  }
  void add_inflections(double lo, double hi, Knots<4>& knots) const {
    ProductQuartic<3>{{{{1, x, x}, {1, y, y}, {-1, w, w}}}}.add_inflections(lo, hi, knots);
  }
};

/// The ends of [lo, hi] and f's extremes between them.
template <typename Line>
Knots<5> quartic_extremes(const Line& line, double lo, double hi) {
  Knots<4> inflections;
  inflections.add(lo);
  line.add_inflections(lo, hi, inflections);
  inflections.add(hi);
  Knots<5> r;
  r.add(lo);
  for (int i = 0; i + 1 < inflections.count; ++i) {
    const double a = inflections.at[static_cast<std::size_t>(i)];
    const double b = inflections.at[static_cast<std::size_t>(i + 1)];
    if ((line.df(a) < 0) == (line.df(b) < 0)) continue;
    r.add(bracketed_root([&](double s) { return line.df(s); },
                         [&](double s) { return line.ddf(s); }, a, b));
  }
  r.add(hi);
  return r;
}

/// A piece of a ray, from `enter` to `leave`, and the quartic's parameters of its ends; t = (s +
/// nearest) / speed.
struct QuarticRange {
  double enter, leave;
  double s_enter, s_leave;
  double nearest, speed;

  static QuarticRange of_ray(double enter, double leave, double nearest, double speed) {
    return {enter, leave, enter * speed - nearest, leave * speed - nearest, nearest, speed};
  }
  static QuarticRange of_line(double s_enter, double s_leave, double nearest, double speed) {
    return {
        (s_enter + nearest) / speed, (s_leave + nearest) / speed, s_enter, s_leave, nearest, speed};
  }
  double t_of(double s) const { return (s + nearest) / speed; }
};

/// Finds a root between two points of opposite signs.
struct FindRoot {
  template <typename Line>
  double operator()(const Line& line, double a, double b) const {
    return bracketed_root([&](double x) { return line.f(x); }, [&](double x) { return line.df(x); },
                          a, b);
  }
};
/// Finds the same root, to the bit, whichever piece of the line is searched.
struct FindSettledRoot {
  template <typename Line>
  double operator()(const Line& line, double a, double b) const {
    return settled_root([&](double x) { return line.f(x); }, [&](double x) { return line.df(x); },
                        a, b);
  }
};

/// The spans in which the quartic is negative between enter and leave; those that reach an end have
/// exactly its parameter.
template <typename Line, typename Find = FindRoot>
Spans quartic_spans(const Line& line, const QuarticRange& range, const Find& find = {}) {
  const Knots<5> knots = quartic_extremes(line, range.s_enter, range.s_leave);
  Spans spans;
  bool inside = line.f(knots.at[0]) < 0;
  double enter = range.enter;
  const auto leave_at = [&](double t) {
    t = std::fmin(t, range.leave);
    if (t >= enter && spans.count < Spans::kMax) spans.add(enter + 0.0, t + 0.0);
  };
  for (int i = 0; i + 1 < knots.count; ++i) {
    const double a = knots.at[static_cast<std::size_t>(i)];
    const double b = knots.at[static_cast<std::size_t>(i + 1)];
    const bool inside_at_b = line.f(b) < 0;
    if (inside_at_b == inside) continue;
    const double s = find(line, a, b);
    const double t =
        std::fmax(range.t_of(s), spans.count > 0 ? spans.interval[0].leave : range.enter);
    if (inside) {
      leave_at(t);
    } else {
      enter = t;
    }
    inside = inside_at_b;
  }
  if (inside) leave_at(range.leave);
  return spans;
}

/// The point, moved aside a little if the line through it in direction u is the z axis: there a
/// figure that reaches across the axis, turned about it, meets itself, and its quartic only touches
/// zero.
inline Vec3 off_the_axis(const Vec3& point, const Vec3& u) {
  constexpr double kAside = 1e-9;
  const bool is_axis = u.x == 0 && u.y == 0 && point.x == 0 && point.y == 0;
  return is_axis ? Vec3{kAside, 0, point.z} : point;
}

/// Joins two spans when the solid holds what is between them. A figure that reaches across its
/// axis, turned about it, encloses a spindle within itself, where its quartic is positive again;
/// the spindle belongs to the solid.
template <typename Contains>
Spans without_spindle(const Spans& spans, const Ray& ray, Contains&& contains) {
  if (spans.count < 2) return spans;
  const double middle = 0.5 * (spans.interval[0].leave + spans.interval[1].enter);
  if (!contains(ray.at(middle))) return spans;
  Spans joined;
  joined.add(spans.interval[0].enter, spans.interval[1].leave);
  return joined;
}

}  // namespace graycube::csg
