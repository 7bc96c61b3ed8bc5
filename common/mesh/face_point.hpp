// Points of the plane of a face.
#pragma once

namespace graycube {

struct FacePoint {
  double x, y;
};

/// Twice the signed area of a triangle in the plane, above 0 if it is counter-clockwise.
inline double turn(const FacePoint& a, const FacePoint& b, const FacePoint& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace graycube
