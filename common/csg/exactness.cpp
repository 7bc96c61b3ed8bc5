#include "csg/exactness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace graycube {
namespace {

/// Entries that stand alone in their row scale, and are off by a share of themselves. Those of a rotation come from sines:
/// they are off by a share of the largest.
Affine magnitude_of(const Affine& map) {
  Affine r;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = map.m[i];
    const double most = std::max(std::fabs(row[0]), std::max(std::fabs(row[1]), std::fabs(row[2])));
    for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = row[j] == 0 ? 0.0 : most;
    r.m[i][3] = std::fabs(row[3]);
  }
  return r;
}

/// By how much more a normal may turn than the map's entries are off, as a share: normals go by the inverse transposed, and
/// the inverse of A + E differs from that of A by A⁻¹ E A⁻¹.
double turn_of(const MeasuredMap& map) {
  const auto inverse = map.map.inverse();
  if (!inverse) return 1;
  double most = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) sum += std::fabs(inverse->m[i][k]) * map.magnitude.m[k][j];
    }
    most = std::max(most, sum);
  }
  return most;
}

bool keeps_directions(const Affine& map) {
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (i != j && map.m[i][j] != 0) return false;
    }
  }
  return true;
}

}  // namespace

double share_of_digits(std::uint32_t digits) {
  constexpr std::array<double, kDoubleDigits + 1> kHalfUnits{0,     5e-1, 5e-2, 5e-3,  5e-4,  5e-5,  5e-6,  5e-7,  5e-8,
                                                             5e-9,  5e-10, 5e-11, 5e-12, 5e-13, 5e-14, 5e-15, 5e-16, 5e-17};
  return std::max(kRoundedShare, kHalfUnits[std::min(digits, kDoubleDigits)]);
}

MeasuredMap compose(const MeasuredMap& then, const Affine& first) {
  return {compose(then.map, first), compose(then.magnitude, magnitude_of(first))};
}

Exactness exactness_of(const MeasuredMap& map, const Vec3& reach, double turn, double share) {
  Exactness e;
  e.position = share * map.magnitude.point(reach);
  e.direction = share * turn * (keeps_directions(map.map) ? 1 : turn_of(map));
  return e;
}

}  // namespace graycube
