// The families of scenes that Graycube is measured on: deterministic functions of a family, a size
// and a seed. The seed changes the layout, the size the amount of work; the density of what the eye
// sees stays about the same.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "scene/scene.hpp"

namespace graycube::bench {

enum class Family : std::uint8_t {
  kCsg,      // size: primitives. Drilled, cut boxes and lenses over a floor, 20 % mirrors, 2 lights
  kSpheres,  // size: spheres. As kCsg, of whole spheres
  kFlake,    // size: depth d of a sphere flake, 1 + 9 + … + 9^d reflective spheres, 3 lights
  kMenger,   // size: level of a Menger sponge as one difference of boxes; 3 has 1263 holes
  kDeepCsg,  // size: holes. One box minus so many spheres, cut by a sphere
  kGlassLens,  // size: max_depth. Nested and side by side shells, lenses, prisms, bubbles of glass
};

struct FamilyInfo {
  Family family;
  std::string_view name;
  std::uint32_t smallest, largest;
};
/// All families, with the sizes that they can have.
std::span<const FamilyInfo> families();
std::optional<Family> family_of(std::string_view name);

/// A scene with a picture of `image_side` × `image_side` pixels, 1 ray each. The size must be in
/// the family's range.
Scene make_scene(Family family, std::uint32_t size, std::uint64_t seed,
                 std::uint32_t image_side = 512);

}  // namespace graycube::bench
