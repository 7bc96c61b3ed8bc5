#include "coincidence/exactness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace graycube {
namespace {

/// The sizes by which the errors of a map's entries are measured. An entry alone in its row scales,
/// and is off by a share of itself. Entries of a rotation come from sines and their products:
/// however small, they have rounding errors of numbers about as large as the row's largest.
Affine magnitude_of(const Affine& map) {
  constexpr double kLeastPart = 1.0 / 8;
  Affine r;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& row = map.m[i];
    const double most = std::max(std::fabs(row[0]), std::max(std::fabs(row[1]), std::fabs(row[2])));
    for (std::size_t j = 0; j < 3; ++j)
      r.m[i][j] = row[j] == 0 ? 0.0 : std::max(std::fabs(row[j]), kLeastPart * most);
    r.m[i][3] = std::fabs(row[3]);
  }
  return r;
}

/// The inverse, exact enough for measuring errors: that of a near similarity is, more cheaply, its
/// transpose times a factor.
std::optional<Affine> inverse_of(const Affine& map) {
  constexpr double kNearEnough = 1e-3;
  const Vec3 x = map.row(0), y = map.row(1), z = map.row(2);
  const double square = dot(x, x);
  const auto is_near = [&](double a, double b) { return std::fabs(a - b) <= kNearEnough * square; };
  if (!is_near(dot(y, y), square) || !is_near(dot(z, z), square) || !is_near(dot(x, y), 0) ||
      !is_near(dot(y, z), 0) || !is_near(dot(z, x), 0)) {
    return map.inverse();
  }
  Affine r;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = map.m[j][i] / square;
  }
  return r;
}

/// The angle by which a normal may turn, over the relative error of the map's entries: normals go
/// by the transposed inverse, and the inverse of A + E differs from that of A by A⁻¹ E A⁻¹.
double turn_of(const Affine& map, const Affine& magnitude) {
  const auto inverse = inverse_of(map);
  if (!inverse) return 1;
  double most = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto& row = magnitude.m[k];
      sum += std::fabs(inverse->m[i][k]) * (row[0] + row[1] + row[2]);
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
  constexpr std::array<double, kDoubleDigits + 1> kHalfUnits{
      0,    5e-1,  5e-2,  5e-3,  5e-4,  5e-5,  5e-6,  5e-7,  5e-8,
      5e-9, 5e-10, 5e-11, 5e-12, 5e-13, 5e-14, 5e-15, 5e-16, 5e-17};
  return std::max(kRoundedShare, kHalfUnits[std::min(digits, kDoubleDigits)]);
}

MeasuredMap compose(const MeasuredMap& then, const Affine& first) {
  MeasuredMap r{first, magnitude_of(first), 1, false};
  if (!then.is_identity) {
    r.map = compose(then.map, r.map);
    r.magnitude = compose(then.magnitude, r.magnitude);
  } else {
    // Turns −0 into +0 as compose() does: maps that are equal have equal bits.
    for (auto& row : r.map.m) {
      for (double& x : row) x += 0.0;
    }
  }
  if (!keeps_directions(r.map)) r.turn = turn_of(r.map, r.magnitude);
  return r;
}

MeasuredMap moving_all_alike(MeasuredMap map, double share, double map_share) {
  for (auto& row : map.magnitude.m) row[3] *= share / map_share;
  return map;
}

Exactness exactness_of(const MeasuredMap& map, const Vec3& reach, double turn, double share,
                       double map_share) {
  Exactness e;
  const Vec3 position =
      share * map.magnitude.vector(reach) + map_share * map.magnitude.translation();
  e.along = {static_cast<float>(position.x), static_cast<float>(position.y),
             static_cast<float>(position.z)};
  e.direction = static_cast<float>(share * turn * map.turn);
  return e;
}

}  // namespace graycube
