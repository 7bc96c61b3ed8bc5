// Colours as materials.
#pragma once

#include <array>
#include <cstdint>
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

/// Which of OpenSCAD's colours stands for components that are left open: the yellow of solids, or
/// the green of what a tool has cut.
enum class ScadFace : std::uint8_t { kOuter, kCut };

/// One material per colour, in the order of first use: "default" and "cut" without a colour, then
/// "color 1", "color 2" and so on. Alpha below 1 becomes transmit = 1 − alpha.
class Palette {
 public:
  MaterialIndex index_of(const ScadColor& color, ScadFace face = ScadFace::kOuter);
  std::vector<NamedMaterial> take() { return std::move(materials_); }

 private:
  std::vector<NamedMaterial> materials_;
  std::map<std::pair<std::array<double, 4>, ScadFace>, MaterialIndex> index_;
  int color_count_ = 0;
};

}  // namespace graycube
