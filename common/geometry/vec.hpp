// Three-component vectors and colours. Plain values, doubles throughout: every node must compute
// the same bits, so nothing here calls a library function whose last bit depends on the processor.
#pragma once

#include <cmath>

namespace graycube {

struct Vec3 {
  double x = 0, y = 0, z = 0;

  constexpr double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr double& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
};

constexpr Vec3 operator+(const Vec3& a, const Vec3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Vec3 operator-(const Vec3& a, const Vec3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
constexpr Vec3 operator*(double s, const Vec3& a) { return {s * a.x, s * a.y, s * a.z}; }
constexpr Vec3 operator*(const Vec3& a, double s) { return s * a; }

constexpr double dot(const Vec3& a, const Vec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
constexpr Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(const Vec3& a) { return std::sqrt(dot(a, a)); }
/// The unit vector along `a`; the zero vector stays zero.
inline Vec3 normalized(const Vec3& a) {
  const double l = length(a);
  return l > 0 ? Vec3{a.x / l, a.y / l, a.z / l} : Vec3{};
}
inline bool is_finite(const Vec3& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}
/// The larger number; a NaN loses. std::fmax is that too, but a call.
inline double larger(double a, double b) { return a > b || b != b ? a : b; }
/// The largest absolute coordinate.
inline double max_abs(const Vec3& a) {
  return larger(std::fabs(a.x), larger(std::fabs(a.y), std::fabs(a.z)));
}

/// Linear RGB, unbounded above.
struct Rgb {
  double r = 0, g = 0, b = 0;
  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

constexpr Rgb operator+(const Rgb& a, const Rgb& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Rgb operator*(const Rgb& a, const Rgb& b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
constexpr Rgb operator*(double s, const Rgb& a) { return {s * a.r, s * a.g, s * a.b}; }
inline double max_component(const Rgb& a) { return larger(a.r, larger(a.g, a.b)); }

}  // namespace graycube
