// Finds where a light sees an object, texel by texel of the cube map around the light.
#pragma once

#include <cstdint>
#include <vector>

#include "csg/model.hpp"

namespace graycube {

/// A texel in which an object shows, and a distance from the light (scene units, ≥ 0) below which
/// none of its surfaces begins there.
struct Sight {
  std::uint32_t texel;
  float begin;
};

class LightView {
 public:
  /// The model must outlive the view.
  LightView(const Model& model, const Vec3& light) : model_(model), light_(light) {}

  /// Appends each texel of a map of LightHorizons::kSide in which a surface of an object of the
  /// model may show, once. Conservative: texels may be too many, distances too small.
  void look_at(const Object& object, std::vector<Sight>& seen) const;

 private:
  const Model& model_;
  Vec3 light_;
};

}  // namespace graycube
