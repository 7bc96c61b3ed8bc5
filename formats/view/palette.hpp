// Colours as materials.
#pragma once

#include <array>
#include <map>
#include <utility>
#include <vector>

#include "scene/scene.hpp"

namespace graycube {

/// sRGB and alpha, 0 … 1, or negative where the file leaves a component open.
struct ScadColor {
  std::array<double, 4> rgba{-1, -1, -1, -1};
  /// OpenSCAD lets a colour inside count only while none outside it is valid.
  bool is_valid() const { return rgba[0] >= 0 && rgba[1] >= 0 && rgba[2] >= 0 && rgba[3] >= 0; }
};

/// One material per colour, in the order of first use: "default", "color 1", "color 2" and so on.
/// Components left open are those of OpenSCAD's yellow; alpha below 1 becomes transmit = 1 − alpha.
class Palette {
 public:
  MaterialIndex index_of(const ScadColor& color);
  std::vector<NamedMaterial> take() { return std::move(materials_); }

 private:
  std::vector<NamedMaterial> materials_;
  std::map<std::array<double, 4>, MaterialIndex> index_;
  int color_count_ = 0;
};

}  // namespace graycube
