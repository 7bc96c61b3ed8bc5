#include "formats/brlcad/lights.hpp"

#include <algorithm>
#include <string>

#include "formats/brlcad/view.hpp"

namespace graycube::brlcad {
namespace {

/// The brightest lamp gives 1 / (1 + half of the ambient light), so that little is overexposed.
constexpr double kBrightest = 1 + 0.5 * kBrlcadAmbient;
/// The light that rt's default lighting model, -l0, makes (sh_light.c, light_maker(1)), in halves
/// of the view's size: at its left edge, in front of the eye's plane.
constexpr Vec3 kDefaultLight{-1, 0, 1};
/// How far off an infinite light is, in sizes of the model: its rays differ by so little from
/// parallel ones that no pixel shows it.
constexpr double kInfinitelyFar = 1e4;

void add_default_light(double view_size, RenderSettings& settings) {
  const BrlcadAxes axes = brlcad_axes(settings.camera);
  const Vec3& d = kDefaultLight;
  const double brightness = 1 / kBrightest;
  PointLight& light = settings.lights.emplace_back();
  light.position = settings.camera.eye +
                   0.5 * view_size * (d.x * axes.right + d.y * axes.up + d.z * axes.backward);
  light.color = {brightness, brightness, brightness};
  light.shadows = false;
}

/// The part of full light that each lamp gives.
std::vector<double> fractions_of(const std::vector<LampObject>& lamps) {
  double most = 0;
  for (const LampObject& l : lamps) {
    if (!(l.lamp.fraction > 0)) most = std::max(most, l.lamp.intensity);
  }
  std::vector<double> fractions;
  for (const LampObject& l : lamps) {
    fractions.push_back(l.lamp.fraction > 0 ? l.lamp.fraction
                                            : l.lamp.intensity / (most * kBrightest));
  }
  return fractions;
}

/// Where a lamp in `box` shines from.
Vec3 place_of(const BrlcadLamp& lamp, const Aabb& box, const Aabb& whole) {
  if (!lamp.is_infinite) return box.center();
  const Vec3 from_origin = normalized(box.center());
  const Vec3 direction = from_origin == Vec3{} ? Vec3{0, 0, 1} : from_origin;
  return whole.center() + kInfinitelyFar * std::max(length(whole.hi - whole.lo), 1.0) * direction;
}

/// The way that a lamp in `box` is aimed. rt turns a target's direction as it turns its own, −z.
Vec3 aim_of(const LampObject& lamp, const Aabb& box) {
  const Vec3 aim = lamp.lamp.has_target ? normalized(lamp.lamp.target - box.center()) : Vec3{};
  const Vec3 turned = lamp.first_solid.vector(aim == Vec3{} ? Vec3{0, 0, -1} : aim);
  return normalized(turned);
}

}  // namespace

void light_scene(const std::vector<LampObject>& lamps, const std::vector<Aabb>& bounds,
                 double view_size, Scene& scene, BrlcadReport& report) {
  auto& lights = scene.settings.lights;
  Aabb whole = Aabb::nothing();
  for (const Aabb& box : bounds) whole = union_of(whole, box);
  const std::vector<double> fractions = fractions_of(lamps);
  for (std::size_t i = 0; i < lamps.size(); ++i) {
    const auto& [object, lamp, first_solid] = lamps[i];
    Material& material = scene.materials[scene.objects[object].material].material;
    material.ambient = fractions[i];
    if (bounds[object].is_empty()) continue;
    if (lights.size() == kMaxCreditLights) {
      report.changed("lamps",
                     "beyond the first " + std::to_string(kMaxCreditLights) + " they don't shine",
                     scene.objects[object].name);
      continue;
    }
    PointLight& light = lights.emplace_back();
    light.position = place_of(lamp, bounds[object], whole);
    light.color = fractions[i] * material.color;
    light.shadows = lamp.has_shadows;
    light.angle_degrees = lamp.angle_degrees;
    if (light.has_beam()) light.direction = aim_of(lamps[i], bounds[object]);
  }
  for (auto l = lamps.rbegin(); l != lamps.rend(); ++l) {
    if (!l->lamp.is_invisible) continue;
    scene.objects.erase(scene.objects.begin() + static_cast<std::ptrdiff_t>(l->object));
  }
  if (lights.empty()) add_default_light(view_size, scene.settings);
}

}  // namespace graycube::brlcad
