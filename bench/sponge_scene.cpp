// One solid with very many holes: a Menger sponge, and a block full of bubbles.
#include <cmath>

#include "bench/scene_parts.hpp"
#include "geometry/affine.hpp"

namespace graycube::bench {
namespace {

constexpr double kSpongeHalf = 40.5;
/// Holes reach a little beyond the solids that they are cut into, so that no faces coincide.
constexpr double kOverhang = 0.004;

/// Cuts the three square bars out of a cube, then those of the twenty cubes that are left.
void cut_bars(std::vector<CsgNode>& children, const Vec3& center, double half,
              std::uint32_t level) {
  const double reach = half + kOverhang;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 e{half / 3, half / 3, half / 3};
    e[axis] = reach;
    children.push_back(box(center - e, center + e));
  }
  if (level == 1) return;
  for (int i = 0; i < 27; ++i) {
    const Vec3 step{static_cast<double>(i / 9 - 1), static_cast<double>(i / 3 % 3 - 1),
                    static_cast<double>(i % 3 - 1)};
    if (dot(step, step) > 1)
      cut_bars(children, center + (2 * half / 3) * step, half / 3, level - 1);
  }
}

/// Two lights, and a floor that is 5 thick, with its top at `floor_top`.
SceneParts stage(std::uint32_t side, const Vec3& eye, double fov, double floor_top) {
  SceneParts parts(side, eye, {0, -4, 0}, fov);
  parts.light({-120, 200, -140}, 0.7);
  parts.light({180, 120, -60}, 0.45);
  const auto floor = parts.material("floor", {.color = {0.7, 0.7, 0.72}, .diffuse = 0.75});
  parts.object(floor, box({-400, floor_top - 5, -400}, {400, floor_top, 400}));
  return parts;
}

}  // namespace

Scene menger_sponge(std::uint32_t level, std::uint64_t seed, std::uint32_t side) {
  SceneParts parts = stage(side, {75, 90, -165}, 40, -45);
  const auto sponge = parts.material("sponge", {.color = {0.85, 0.55, 0.35},
                                                .ambient = 0.12,
                                                .diffuse = 0.65,
                                                .specular = 0.2,
                                                .shininess = 20});
  const Vec3 half{kSpongeHalf, kSpongeHalf, kSpongeHalf};
  std::vector<CsgNode> children{box(-half, half)};
  cut_bars(children, {}, kSpongeHalf, level);
  CsgNode solid = operation(Operation::kDifference, std::move(children));
  Affine turn = rotation({0, 1, 0}, Dice(seed).between(12, 40));
  for (auto& row : turn.m) {
    for (double& element : row) element = nine_digits(element);
  }
  solid.transform = turn;
  parts.object(sponge, std::move(solid));
  return parts.take();
}

Scene drilled_block(std::uint32_t holes, std::uint64_t seed, std::uint32_t side) {
  SceneParts parts = stage(side, {95, 80, -160}, 42, -70);
  const auto cheese = parts.material("cheese", {.color = {0.95, 0.8, 0.3},
                                                .ambient = 0.12,
                                                .diffuse = 0.65,
                                                .specular = 0.3,
                                                .shininess = 30});
  Dice dice(seed);
  const double scale = std::cbrt(2000.0 / holes);
  std::vector<CsgNode> children{box({-50, -50, -50}, {50, 50, 50})};
  for (std::uint32_t i = 0; i < holes; ++i) {
    const Vec3 center = dice.point_between({-50, -50, -50}, {50, 50, 50});
    children.push_back(sphere(center, scale * dice.between(3, 7)));
  }
  CsgNode drilled = operation(Operation::kDifference, std::move(children));
  parts.object(cheese, operation(Operation::kIntersection, {std::move(drilled), sphere({}, 64)}));
  return parts.take();
}

}  // namespace graycube::bench
