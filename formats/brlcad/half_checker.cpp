#include "formats/brlcad/half_checker.hpp"

#include <cmath>

namespace graycube::brlcad {
namespace {

/// The sides of the squares at scale 2: on a half-space, u and v go from 0 to 1 and back over 10 m
/// (liboptical's sh_text.c, librt's half.c).
constexpr double kSide = 5000;
/// The sides of the checker's cubes across the plane: all of a model lies within one.
constexpr double kDepth = 1e12;

}  // namespace

Vec3 across(const Vec3& normal) {
  const Vec3 size{std::fabs(normal.x), std::fabs(normal.y), std::fabs(normal.z)};
  Vec3 axis{1, 0, 0};
  if (size.y < size.x) axis = {0, 1, 0};
  if (size.z < std::fmin(size.x, size.y)) axis = {0, 0, 1};
  return normalized(cross(axis, normal));
}

std::optional<Pattern> half_space_checker(const Pattern& on_surface, const BrlcadSolid& solid,
                                          const Affine& to_world) {
  if (solid.kind != BrlcadKind::kHalf || on_surface.kind != PatternKind::kChecker ||
      on_surface.to_pattern != scaling({2, 2, 1})) {
    return std::nullopt;
  }
  const auto& v = solid.values;
  const Vec3 own{v[0], v[1], v[2]};
  const Vec3 normal = normalized(to_world.vector(own));
  const Vec3 center = dot(normal, to_world.point(v[3] * own)) * normal;
  const Vec3 x = (1 / kSide) * across(normal);
  const Vec3 y = (1 / kSide) * normalized(cross(x, normal));
  Pattern pattern = on_surface;
  const Vec3 z = (1 / kDepth) * normal;
  // The middle of a cube is where the normal through the origin meets the plane.
  pattern.to_pattern.m = {{{x.x, x.y, x.z, 0.5 - dot(x, center)},
                           {y.x, y.y, y.z, 0.5 - dot(y, center)},
                           {z.x, z.y, z.z, 0.5 - dot(z, center)}}};
  return pattern;
}

}  // namespace graycube::brlcad
