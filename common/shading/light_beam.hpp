// Where a light shines: within an angle about an axis, with a hard edge, or everywhere.
#pragma once

#include "geometry/portable_math.hpp"
#include "geometry/vec.hpp"
#include "shading/settings.hpp"

namespace graycube {

class LightBeam {
 public:
  explicit LightBeam(const PointLight& light)
      : axis_(normalized(light.direction)),
        least_cosine_(cos_degrees(light.angle_degrees)),
        is_everywhere_(!light.has_beam()) {}

  bool is_everywhere() const { return is_everywhere_; }
  /// Whether the light reaches a point, if nothing is in its way; `to_light` is the unit direction
  /// from there to the light.
  bool reaches(const Vec3& to_light) const {
    return is_everywhere_ || -dot(to_light, axis_) >= least_cosine_;
  }

 private:
  Vec3 axis_;
  double least_cosine_;
  bool is_everywhere_;
};

}  // namespace graycube
