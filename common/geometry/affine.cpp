#include "geometry/affine.hpp"

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "check.hpp"
#include "geometry/portable_math.hpp"

namespace graycube {
namespace {

constexpr double kSingular = 1e-12;
constexpr double kSimilarityTolerance = 1e-14;

Vec3 column(const Affine& a, std::size_t j) { return {a.m[0][j], a.m[1][j], a.m[2][j]}; }

Affine from_rows(const Vec3& r0, const Vec3& r1, const Vec3& r2, const Vec3& t) {
  // Adding +0 turns −0 into +0: maps that are equal have equal bits.
  Affine a;
  a.m = {{{r0.x + 0.0, r0.y + 0.0, r0.z + 0.0, t.x + 0.0},
          {r1.x + 0.0, r1.y + 0.0, r1.z + 0.0, t.y + 0.0},
          {r2.x + 0.0, r2.y + 0.0, r2.z + 0.0, t.z + 0.0}}};
  return a;
}

/// 2^-k for the k that brings the vector's largest coordinate into [1/2, 1); nothing for zero.
/// Scaling by it is exact, and keeps products of three coordinates away from overflow and
/// underflow.
std::optional<double> balancing_factor(const Vec3& v) {
  const double largest = max_abs(v);
  if (!(largest > 0) || !std::isfinite(largest)) return std::nullopt;
  // Without the library's calls where both exponents are those of normal numbers.
  const std::uint64_t biased = std::bit_cast<std::uint64_t>(largest) >> 52;
  constexpr std::uint64_t kBiasSum = 2 * 1022 + 1;
  if (biased >= 1 && biased < kBiasSum) return std::bit_cast<double>((kBiasSum - biased) << 52);
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double factor = std::ldexp(1.0, -exponent);
  if (!std::isfinite(factor)) return std::nullopt;
  return factor;
}

/// The inverse of a map whose rows may have any lengths.
std::optional<Affine> inverse_by_rows(const Affine& map) {
  const auto f0 = balancing_factor(map.row(0));
  const auto f1 = balancing_factor(map.row(1));
  const auto f2 = balancing_factor(map.row(2));
  if (!f0 || !f1 || !f2) return std::nullopt;
  const Vec3 r0 = *f0 * map.row(0), r1 = *f1 * map.row(1), r2 = *f2 * map.row(2);

  const Vec3 c0 = cross(r1, r2);
  const double det = dot(r0, c0);
  // Negated so that a NaN counts as singular.
  if (!(std::fabs(det) >= kSingular * length(r0) * length(r1) * length(r2))) return std::nullopt;
  const Vec3 c1 = cross(r2, r0), c2 = cross(r0, r1);

  // The cofactor vectors are the columns of the balanced inverse times det; each row's factor comes
  // back in its column. Dividing, rather than multiplying by 1/det, keeps exact quotients exact.
  const auto entry = [det](double cofactor, double factor) { return cofactor / det * factor; };
  const Vec3 i0{entry(c0.x, *f0), entry(c1.x, *f1), entry(c2.x, *f2)};
  const Vec3 i1{entry(c0.y, *f0), entry(c1.y, *f1), entry(c2.y, *f2)};
  const Vec3 i2{entry(c0.z, *f0), entry(c1.z, *f1), entry(c2.z, *f2)};
  const Vec3 t = map.translation();
  return from_rows(i0, i1, i2, {-dot(i0, t), -dot(i1, t), -dot(i2, t)});
}

/// The inverse of a map whose columns may have very different lengths, as those of a frame that is
/// turned against the axes have: with columns of about one length it is inverted by its rows, whose
/// inverse then gets the columns' factors.
std::optional<Affine> inverse_by_columns(const Affine& map) {
  Affine balanced = map;
  std::array<double, 3> factors{};
  for (std::size_t j = 0; j < 3; ++j) {
    const auto factor = balancing_factor(column(map, j));
    if (!factor) return std::nullopt;
    factors[j] = *factor;
    for (auto& row : balanced.m) row[j] *= *factor;
  }
  auto inverse = inverse_by_rows(balanced);
  if (!inverse) return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) {
    for (double& v : inverse->m[i]) v = v * factors[i] + 0.0;
  }
  return inverse;
}

}  // namespace

double Affine::determinant() const { return dot(row(0), cross(row(1), row(2))); }

std::optional<Affine> Affine::inverse() const {
  for (const auto way : {inverse_by_rows, inverse_by_columns}) {
    if (auto result = way(*this); result && result->is_finite()) return result;
  }
  return std::nullopt;
}

std::optional<double> Affine::similarity_scale() const {
  const Vec3 c0 = column(*this, 0), c1 = column(*this, 1), c2 = column(*this, 2);
  const double square = dot(c0, c0);
  if (!(square > 0) || !std::isfinite(square)) return std::nullopt;
  // A relative error of e in a length is one of 2e in its square.
  const auto same_length = [square](const Vec3& c) {
    return std::fabs(dot(c, c) - square) <= 2 * kSimilarityTolerance * square;
  };
  const auto orthogonal = [square](const Vec3& a, const Vec3& b) {
    return std::fabs(dot(a, b)) <= kSimilarityTolerance * square;
  };
  if (!same_length(c1) || !same_length(c2)) return std::nullopt;
  if (!orthogonal(c0, c1) || !orthogonal(c1, c2) || !orthogonal(c2, c0)) return std::nullopt;
  return std::sqrt(square);
}

bool Affine::is_finite() const {
  // Infinities and NaN less themselves are NaN, and so is every sum with one.
  double sum = 0;
  for (const auto& row : m) {
    for (const double x : row) sum += x - x;
  }
  return sum == 0;
}

Affine compose(const Affine& then, const Affine& first) {
  Affine result;
  for (std::size_t j = 0; j < 4; ++j) {
    const Vec3 c = j < 3 ? then.vector(column(first, j)) : then.point(column(first, j));
    for (int i = 0; i < 3; ++i) result.m[static_cast<std::size_t>(i)][j] = c[i];
  }
  return result;
}

Affine translation(const Vec3& offset) {
  return from_rows({1, 0, 0}, {0, 1, 0}, {0, 0, 1}, offset);
}

Affine scaling(const Vec3& factors) {
  return from_rows({factors.x, 0, 0}, {0, factors.y, 0}, {0, 0, factors.z}, {});
}

Affine rotation(const Vec3& axis, double angle_degrees) {
  const double largest = max_abs(axis);
  GRAYCUBE_CHECK(largest > 0 && is_finite(axis), "axis (%g, %g, %g)", axis.x, axis.y, axis.z);
  const Vec3 u = normalized({axis.x / largest, axis.y / largest, axis.z / largest});
  const double c = cos_degrees(angle_degrees), s = sin_degrees(angle_degrees), v = 1 - c;
  // Rodrigues' formula. The diagonal as u² + c (1 − u²), not c + (1 − c) u², is exactly 1 on the
  // axis.
  const auto diagonal = [c](double w) { return w * w + c * (1 - w * w); };
  return from_rows({diagonal(u.x), v * u.x * u.y - s * u.z, v * u.x * u.z + s * u.y},
                   {v * u.y * u.x + s * u.z, diagonal(u.y), v * u.y * u.z - s * u.x},
                   {v * u.z * u.x - s * u.y, v * u.z * u.y + s * u.x, diagonal(u.z)}, {});
}

}  // namespace graycube
