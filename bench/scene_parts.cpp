#include "bench/scene_parts.hpp"

#include <charconv>
#include <utility>

namespace graycube::bench {
namespace {

/// A unit quaternion's rotation (Shoemake 1985).
Affine turned(double w, const Vec3& v) {
  const auto& [x, y, z] = v;
  Affine a;
  a.m = {{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 0},
          {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 0},
          {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), 0}}};
  return a;
}

constexpr std::array<Rgb, kMattes> kMatteColors{{{0.85, 0.25, 0.2},
                                                 {0.2, 0.6, 0.9},
                                                 {0.95, 0.75, 0.2},
                                                 {0.35, 0.75, 0.35},
                                                 {0.75, 0.4, 0.8},
                                                 {0.9, 0.9, 0.88},
                                                 {0.95, 0.5, 0.2},
                                                 {0.3, 0.35, 0.8}}};

}  // namespace

double nine_digits(double value) {
  char text[40];
  const auto end =
      std::to_chars(text, text + sizeof text, value, std::chars_format::general, 9).ptr;
  double rounded = 0;
  std::from_chars(text, end, rounded);
  return rounded + 0.0;
}
Vec3 nine_digits(const Vec3& v) { return {nine_digits(v.x), nine_digits(v.y), nine_digits(v.z)}; }

Affine random_placement(Dice& dice, const Vec3& to) {
  double w = 0;
  Vec3 v;
  double norm = 0;
  do {  // uniform in the four-dimensional ball, so the direction is uniform
    w = dice.between(-1, 1);
    v = dice.point_between({-1, -1, -1}, {1, 1, 1});
    norm = std::sqrt(w * w + dot(v, v));
  } while (norm < 0.01 || norm > 1);
  Affine placement = turned(w / norm, (1 / norm) * v);
  for (std::size_t i = 0; i < 3; ++i) {
    placement.m[i][3] = to[static_cast<int>(i)];
    for (double& element : placement.m[i]) element = nine_digits(element);
  }
  return placement;
}

CsgNode sphere(const Vec3& center, double radius) {
  return leaf(SphereShape{nine_digits(center), nine_digits(radius)});
}
CsgNode box(const Vec3& lo, const Vec3& hi) {
  return leaf(BoxShape{nine_digits(lo), nine_digits(hi)});
}
CsgNode cylinder(const Vec3& base, const Vec3& top, double radius) {
  return leaf(CylinderShape{nine_digits(base), nine_digits(top), nine_digits(radius)});
}
CsgNode operation(Operation operation, std::vector<CsgNode> children) {
  return leaf(OperationNode{operation, std::move(children)});
}

SceneParts::SceneParts(std::uint32_t side, const Vec3& eye, const Vec3& look_at, double fov_degrees,
                       const Vec3& up) {
  RenderSettings& s = scene_.settings;
  s.image = {side, side, 1};
  s.camera.eye = eye;
  s.camera.look_at = look_at;
  s.camera.up = up;
  s.camera.fov_degrees = fov_degrees;
  s.background = {0.15, 0.2, 0.35};
  s.max_depth = 4;
}

void SceneParts::light(const Vec3& position, double grey) {
  scene_.settings.lights.push_back({position, {grey, grey, grey}});
}

MaterialIndex SceneParts::material(std::string name, const Material& material) {
  scene_.materials.push_back({std::move(name), material});
  return static_cast<MaterialIndex>(scene_.materials.size() - 1);
}

MaterialIndex SceneParts::mattes(double ambient, double diffuse, double specular,
                                 double shininess) {
  const auto first = static_cast<MaterialIndex>(scene_.materials.size());
  for (std::size_t i = 0; i < kMattes; ++i) {
    material("matte" + std::to_string(i), {.color = kMatteColors[i],
                                           .ambient = ambient,
                                           .diffuse = diffuse,
                                           .specular = specular,
                                           .shininess = shininess});
  }
  return first;
}

void SceneParts::object(MaterialIndex material, CsgNode csg) {
  const std::string name = "o" + std::to_string(scene_.objects.size());
  scene_.objects.push_back({name, material, std::move(csg)});
}

}  // namespace graycube::bench
