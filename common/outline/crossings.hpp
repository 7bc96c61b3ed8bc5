// Where a function along a piece of an outline changes its sign. The signs at the ends are given,
// and whether an odd or an even number of changes is found depends on them alone: pieces that meet
// give their common end the same sign, so that all pieces of a closed outline together have an even
// number, whatever is rounded between.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

namespace graycube {

/// Halvings of a piece in the search for sign changes. Two that are nearer to each other than
/// 2⁻²⁶ of the piece's parameter may be taken for a touch, which is none.
inline constexpr int kMaxCrossingHalvings = 26;
/// More than enough: bisection alone settles a double's bits in fewer.
inline constexpr int kMaxCrossingRounds = 100;

/// Sign changes in a row of Bernstein coefficients, of which the first and the last have the given
/// signs. By Descartes' rule there are no more sign changes of the polynomial, and fewer only by an
/// even number. Coefficients no larger than `error`, by which they may be off, are left out: if
/// they were taken for what they seem, a polynomial that is zero but for rounding would be halved
/// into all its 2²⁶ parts.
inline int sign_changes(std::span<const double> coefficients, double error, bool first_negative,
                        bool last_negative) {
  int changes = 0;
  bool negative = first_negative;
  for (std::size_t i = 1; i + 1 < coefficients.size(); ++i) {
    const double b = coefficients[i];
    if (std::fabs(b) <= error || (b < 0) == negative) continue;
    negative = !negative;
    ++changes;
  }
  return changes + (negative != last_negative ? 1 : 0);
}

/// The parameter v in [0, 1] at which arc.value(v) changes its sign, which it does: by Newton's
/// method, kept in a shrinking bracket.
template <typename Arc>
double sign_change(const Arc& arc, bool begins_negative) {
  constexpr double kEnough = 0x1p-54;
  double lo = 0, hi = 1, v = 0.5;
  for (int round = 0; round < kMaxCrossingRounds; ++round) {
    const double value = arc.value(v);
    if ((value < 0) == begins_negative) {
      lo = v;
    } else {
      hi = v;
    }
    double next = v - value / arc.slope(v);
    if (!(next > lo && next < hi)) next = 0.5 * (lo + hi);
    if (std::fabs(next - v) <= kEnough || !(lo < next && next < hi)) return next;
    v = next;
  }
  return v;
}

/// Calls visit(arc, v) for the sign changes of an arc (Lane & Riesenfeld 1981): it is halved until
/// its Bernstein coefficients have no sign change, which the polynomial then has neither, or one,
/// which it then has, too. An Arc has changes(first sign, last sign), halves(),
/// is_negative_at_end() (the sign where its second half begins), value() and slope().
template <typename Arc, typename Visit>
void each_sign_change(const Arc& arc, bool begins_negative, bool ends_negative, Visit& visit,
                      int halvings = kMaxCrossingHalvings) {
  const int changes = arc.changes(begins_negative, ends_negative);
  if (changes == 0) return;
  if (changes == 1 || halvings == 0) {
    if (begins_negative != ends_negative) visit(arc, sign_change(arc, begins_negative));
    return;
  }
  const auto halves = arc.halves();
  const bool middle_negative = halves.first.is_negative_at_end();
  each_sign_change(halves.first, begins_negative, middle_negative, visit, halvings - 1);
  each_sign_change(halves.second, middle_negative, ends_negative, visit, halvings - 1);
}

}  // namespace graycube
