// How much of a model is left, as rays at random tell, and whether anything round is.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <string>

#include "crossings/surface_tree.hpp"
#include "formats/openscad/reading.hpp"
#include "scene/compile_scene.hpp"

namespace graycube::testing {

/// The number of 3000 rays of a seed through the origin's neighbourhood that meet anything.
inline int rays_that_hit(const std::string& text, std::uint64_t seed,
                         const OpenscadOptions& options = {}) {
  INFO(text);
  const Model model = compile_scene(scene_of(text, options));
  const SurfaceTree tree = SurfaceTree::build(model);
  TreeScratch scratch;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-16, 16);
  const auto point = [&] { return Vec3{place(random), place(random), place(random)}; };
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 at = point(), from = at + 10.0 * point();
    const Ray ray{from, normalized(at - from)};
    hits += tree.first_crossing(ray, 0, std::numeric_limits<double>::infinity(), scratch) ? 1 : 0;
  }
  return hits;
}

inline bool has_round(const CsgNode& node) {
  if (const auto* inner = std::get_if<OperationNode>(&node.value)) {
    return std::any_of(inner->children.begin(), inner->children.end(),
                       [](const CsgNode& child) { return has_round(child); });
  }
  return std::holds_alternative<SphereShape>(node.value) ||
         std::holds_alternative<CylinderShape>(node.value) ||
         std::holds_alternative<ConeShape>(node.value) ||
         std::holds_alternative<TorusShape>(node.value) ||
         std::holds_alternative<EllipticTorusShape>(node.value);
}
/// Whether any leaf of a model is round.
inline bool has_round(const std::string& text, OpenscadProgram* program = nullptr) {
  OpenscadOptions options;
  options.program = program;
  const Scene scene = scene_of(text, options);
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [](const SceneObject& o) { return has_round(o.csg); });
}

inline const std::string kAside = "multmatrix([[1, 0, 0, -40], [0, 1, 0, 5], [0, 0, 1, 0]]) ";
/// rotate([20, 0, 30]) in six digits.
inline const std::string kTurned =
    "multmatrix([[0.866025, -0.469846, 0.17101, 0], [0.5, 0.813798, -0.296198, 0], "
    "[0, 0.34202, 0.939693, 0], [0, 0, 0, 1]]) ";

/// The hull of a part and a cylinder that lies across: with something upright, there is no exact
/// form.
inline std::string hull_of(const std::string& part) {
  return "hull() { " + part +
         "multmatrix([[1, 0, 0, 30], [0, 0, -1, 0], [0, 1, 0, 4], [0, 0, 0, 1]]) "
         "cylinder($fn = 30, h = 10, r1 = 4, r2 = 4); } ";
}

/// Nothing of the part is left once the other, of facets, is taken from it, nor is it round; with
/// the other aside the part is there, and round.
inline void check_flush(const std::string& part, const std::string& other, std::uint64_t seed) {
  for (const std::string& turn : {std::string{}, kTurned}) {
    CHECK(rays_that_hit(turn + "difference() { " + part + other + "}", seed) == 0);
    CHECK(rays_that_hit(turn + "difference() { " + part + kAside + other + "}", seed) > 20);
  }
  CHECK_FALSE(has_round("union() { " + part + other + "}"));
  CHECK(has_round("union() { " + part + kAside + other + "}"));
}

}  // namespace graycube::testing
