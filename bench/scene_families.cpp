#include "bench/scene_families.hpp"

#include <array>

#include "bench/scene_parts.hpp"
#include "check.hpp"

namespace graycube::bench {
namespace {

constexpr std::array<FamilyInfo, 6> kFamilies{{{Family::kCsg, "csg", 4, 10'000'000},
                                               {Family::kSpheres, "spheres", 1, 10'000'000},
                                               {Family::kFlake, "flake", 0, 7},
                                               {Family::kMenger, "menger", 1, 5},
                                               {Family::kDeepCsg, "deepcsg", 1, 1'000'000},
                                               {Family::kGlassLens, "glasslens", 0, 100}}};

}  // namespace

std::span<const FamilyInfo> families() { return kFamilies; }

std::optional<Family> family_of(std::string_view name) {
  for (const FamilyInfo& info : kFamilies) {
    if (info.name == name) return info.family;
  }
  return std::nullopt;
}

Scene make_scene(Family family, std::uint32_t size, std::uint64_t seed, std::uint32_t image_side) {
  const FamilyInfo& info = kFamilies[static_cast<std::size_t>(family)];
  GRAYCUBE_CHECK(info.family == family && size >= info.smallest && size <= info.largest,
                 "family %d, size %u", static_cast<int>(family), size);
  switch (family) {
    case Family::kCsg: return csg_field(size, seed, image_side);
    case Family::kSpheres: return sphere_field(size, seed, image_side);
    case Family::kFlake: return sphere_flake(size, seed, image_side);
    case Family::kMenger: return menger_sponge(size, seed, image_side);
    case Family::kDeepCsg: return drilled_block(size, seed, image_side);
    case Family::kGlassLens: return glass_lenses(size, seed, image_side);
  }
  return {};
}

}  // namespace graycube::bench
