// Scenes of several objects whose faces touch: parts on tables, side by side, let into each other,
// of glass, mirrors and matter. If unturned, all their numbers are short, so that faces which
// coincide do so to the bit.
#pragma once

#include <utility>
#include <vector>

#include "coincidence/columns.hpp"
#include "coincidence/pair_pictures.hpp"
#include "coincidence/retold.hpp"

namespace graycube::testing {

/// Brings nodes to one place, each in its own way and its own numbers.
class OtherWays {
 public:
  OtherWays(Chain chain, Dice& dice) : chain_(std::move(chain)), dice_(dice) {}

  CsgNode operator()(const CsgNode& node) {
    return told_anew(node, rewritten(chain_, dice_, 1, 1 + dice_.below(6)), dice_);
  }
  Affine map() const { return map_of(chain_); }

 private:
  Chain chain_;
  Dice& dice_;
};

/// A turn and a translation, which keep lengths and handedness.
inline Chain some_turn_and_move(Dice& dice) {
  return {Move::rotate(dice.unit_vector(), chains::round_angle(dice)),
          Move::translate(dice.point(2)), Move::rotate(dice.axis(), chains::round_angle(dice))};
}

inline Scene scene_with_settings(const RenderSettings& settings,
                                 const std::vector<Material>& materials) {
  Scene scene;
  scene.settings = settings;
  for (const Material& m : materials)
    scene.materials.push_back({"m" + std::to_string(scene.materials.size()), m});
  return scene;
}

/// Settings that look at the origin of a scene about 4 across, with two lights.
inline RenderSettings settings_around_origin(Dice& dice, std::uint32_t side) {
  RenderSettings s;
  s.image = {side, side, 1};
  s.camera.eye = 8 * normalized(dice.unit_vector() + Vec3{0, 0, 1.2});
  s.camera.look_at = {0.1, -0.05, 0.2};
  s.camera.up = {0.1, 1, 0.3};
  s.camera.fov_degrees = 32;
  s.background = {0.1, 0.2, 0.3};
  s.max_depth = 4;
  s.lights.push_back(
      {9 * normalized(dice.unit_vector() + Vec3{0, 0, 1.5}), {0.6, 0.6, 0.5}, Falloff::kNone});
  s.lights.push_back({9 * dice.unit_vector(), {0.4, 0.3, 0.4}, Falloff::kNone});
  s.aovs = AovSet::all();
  return s;
}

inline Material coloured(const Rgb& color) {
  Material m;
  m.color = color;
  m.ambient = 0.2;
  m.diffuse = 0.7;
  return m;
}

/// Settings with the same view of a scene that a rigid map has moved.
inline RenderSettings moved_settings(RenderSettings s, const Affine& map) {
  s.camera.up = map.vector(s.camera.up);
  s.camera.eye = map.point(s.camera.eye);
  s.camera.look_at = map.point(s.camera.look_at);
  for (PointLight& l : s.lights) l.position = map.point(l.position);
  return s;
}

/// Solids about the origin that touch: a table with its top at 0; standing on it, side by side and
/// in one another, boxes and round solids of the same height or twice that.
inline std::vector<CsgNode> touching_solids(Dice& dice) {
  std::vector<CsgNode> solids{node_of(BoxShape{{-2, -2, -0.5}, {2, 2, 0}})};
  // A row of boxes that share their sides, one behind the other.
  double x = -1.5;
  for (int i = 0; i < 3; ++i) {
    const double width = 0.25 * static_cast<double>(2 + dice.below(3));
    const double height = 0.25 * static_cast<double>(2 + dice.below(3));
    solids.push_back(node_of(BoxShape{{x, -1.5, 0}, {x + width, -0.5, height}}));
    x += width;
  }
  // One box is let into another, level with its top; and one stands upon the other.
  solids.push_back(node_of(BoxShape{{-1.5, 0.25, 0}, {0, 1.5, 0.5}}));
  solids.push_back(node_of(CylinderShape{{-0.75, 0.875, -0.25}, {-0.75, 0.875, 0.5}, 0.375}));
  solids.push_back(node_of(CylinderShape{{1, 0.875, 0}, {1, 0.875, 0.5}, 0.5}));
  solids.push_back(node_of(ConeShape{{1, 0.875, 0.5}, 0.5, {1, 0.875, 1}, 0.25}));
  for (std::size_t i = solids.size(); i > 1; --i) std::swap(solids[i - 1], solids[dice.below(i)]);
  return solids;
}

/// Makes each solid an object; materials are given in turn.
inline void add_objects(Scene& scene, std::vector<CsgNode> solids) {
  for (CsgNode& s : solids) {
    const auto material = static_cast<MaterialIndex>(scene.objects.size() % scene.materials.size());
    scene.objects.push_back({"", material, std::move(s)});
  }
}

}  // namespace graycube::testing
