// Values that many records of a model slice have.
#pragma once

#include <cmath>

#include "geometry/vec.hpp"
#include "proto/bytes.hpp"

namespace graycube {

inline void put_vec(ByteWriter& w, const Vec3& v) {
  w.put(v.x);
  w.put(v.y);
  w.put(v.z);
}

inline void put_rgb(ByteWriter& w, const Rgb& c) {
  w.put(c.r);
  w.put(c.g);
  w.put(c.b);
}

inline Vec3 get_vec(ByteReader& r) {
  const auto x = r.get<double>(), y = r.get<double>(), z = r.get<double>();
  return {x, y, z};
}

inline Rgb get_rgb(ByteReader& r) {
  const Vec3 v = get_vec(r);
  return {v.x, v.y, v.z};
}

inline bool is_coefficient(double v) { return std::isfinite(v) && v >= 0; }
inline bool is_color(const Rgb& c) {
  return is_coefficient(c.r) && is_coefficient(c.g) && is_coefficient(c.b);
}

}  // namespace graycube
