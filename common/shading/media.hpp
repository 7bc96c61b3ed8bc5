// What light passes through between surfaces: the insides of solids that dim it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "geometry/vec.hpp"
#include "shading/material.hpp"

namespace graycube {

/// Number of a medium: 1 for the first material that dims light on its way, 2 for the next …; 0 for
/// what dims none.
using Medium = std::uint16_t;

class Media {
 public:
  Media() = default;
  explicit Media(std::span<const Material> materials);

  bool empty() const { return materials_.empty(); }
  std::size_t count() const { return materials_.size(); }
  /// The medium within solids of a material, by the material's index.
  Medium of(std::uint32_t material) const;
  /// The share of light that is left after `distance` scene units, which may be infinite, in a
  /// medium other than 0: e^−ad (Bouguer 1729, Lambert 1760).
  Rgb left_after(Medium medium, double distance) const;

 private:
  /// Indices of the materials that dim light, in their order, and by how much.
  std::vector<std::uint32_t> materials_;
  std::vector<Rgb> attenuation_;
};

}  // namespace graycube
