// Coordinates in which the cells of a screen's subdivision are boxes: (x/z, y/z, z) for a
// perspective camera, (x, y, z) for an orthographic one, with x to the right, y down and z forward
// from the eye. Planes through the eye are planes of equal x/z or y/z.
//
// In perspective they hold for the half of space in front of the eye alone, z ≥ 0. What is behind
// it is seen by a second camera at the same place, which looks backward: −z takes the place of z.
#pragma once

#include "csg/primitive.hpp"
#include "geometry/ray.hpp"
#include "regions/camera.hpp"

namespace graycube {

class CameraSpace {
 public:
  enum class Direction : std::uint8_t { kForward, kBackward };

  CameraSpace(const CameraFrame& frame, Direction direction);

  bool is_perspective() const { return is_perspective_; }
  /// All of this space, in its coordinates: z is not below 0 in perspective.
  Aabb everything() const;
  /// A point's x, y and z.
  Vec3 place_of(const Vec3& point) const { return turned(point - eye_); }
  /// x, y and z along a ray.
  Ray line_of(const Ray& ray) const { return {place_of(ray.origin), turned(ray.direction)}; }
  /// Encloses, in the space's coordinates, every point of a primitive in it, grown by `grow` in
  /// scene units; empty when there is none. Everything for unbounded primitives.
  Aabb bounds_of(const Primitive& primitive, double grow) const;
  /// Encloses a cell in the world; everything for unbounded cells.
  Aabb world_box(const Aabb& cell) const;

 private:
  Vec3 turned(const Vec3& v) const {
    return {dot(v, axes_[0]), dot(v, axes_[1]), dot(v, axes_[2])};
  }
  Aabb projection_of(const Aabb& box, double grow) const;
  void clip_to_sphere(const Vec3& center, double radius, Aabb& bounds) const;

  bool is_perspective_;
  Vec3 eye_;
  std::array<Vec3, 3> axes_;
};

}  // namespace graycube
