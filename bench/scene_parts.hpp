// Parts from which the scene families are put together.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/dice.hpp"
#include "scene/scene.hpp"

namespace graycube::bench {

/// Rounds to nine digits, as scene files of other programs have. Sixteen would take longer to read,
/// and a turned sphere would be one to the last bit, which is intersected in another way.
double nine_digits(double value);
Vec3 nine_digits(const Vec3& v);

/// A rotation as rows, all being equally likely, followed by a translation.
Affine random_placement(Dice& dice, const Vec3& to);

template <typename Shape>
CsgNode leaf(const Shape& shape) {
  CsgNode node;
  node.value = shape;
  return node;
}
CsgNode sphere(const Vec3& center, double radius);
CsgNode box(const Vec3& lo, const Vec3& hi);
CsgNode cylinder(const Vec3& base, const Vec3& top, double radius);
CsgNode operation(Operation operation, std::vector<CsgNode> children);

/// A scene under construction.
class SceneParts {
 public:
  /// A perspective camera, +y up unless told otherwise, and a picture of `side` × `side` pixels.
  SceneParts(std::uint32_t side, const Vec3& eye, const Vec3& look_at, double fov_degrees,
             const Vec3& up = {0, 1, 0});

  RenderSettings& settings() { return scene_.settings; }
  void light(const Vec3& position, double grey);
  MaterialIndex material(std::string name, const Material& material);
  /// Eight matte colours, "matte0" to "matte7"; returns the first one's index.
  MaterialIndex mattes(double ambient, double diffuse, double specular, double shininess);
  /// Adds an object; their names are "o0", "o1" and so on.
  void object(MaterialIndex material, CsgNode csg);

  Scene take() { return std::move(scene_); }

 private:
  Scene scene_;
};

inline constexpr std::uint32_t kMattes = 8;

// One function a family, one or two families a file; arguments as those of make_scene().
Scene csg_field(std::uint32_t primitives, std::uint64_t seed, std::uint32_t side);
Scene sphere_field(std::uint32_t spheres, std::uint64_t seed, std::uint32_t side);
Scene sphere_flake(std::uint32_t depth, std::uint64_t seed, std::uint32_t side);
Scene menger_sponge(std::uint32_t level, std::uint64_t seed, std::uint32_t side);
Scene drilled_block(std::uint32_t holes, std::uint64_t seed, std::uint32_t side);
Scene glass_lenses(std::uint32_t max_depth, std::uint64_t seed, std::uint32_t side);

}  // namespace graycube::bench
