// Light horizons: for each light, a cube map of the least distance at which any surface of the
// scene may begin in that direction (design section 10). A shadow ray that is nearer to its light
// than that meets nothing more, whatever process holds the space between: it needs no walk and no
// message. Where shadow rays go, finer texels also hold the distance beyond which no light arrives
// at all (light_depths.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "csg/model.hpp"
#include "geometry/infinity.hpp"
#include "visibility/cube_map.hpp"

namespace graycube {

/// Finer texels that replace some texels of a light's horizon map: a block for each of these.
struct LightDepths {
  /// The number of texels of `dark` along a side of one texel of `lit`.
  static constexpr std::uint32_t kGroup = 2;
  static constexpr std::uint32_t kMostSplit = 32;
  /// Stands for an infinite distance.
  static constexpr std::uint16_t kNever = 0xFFFF;

  /// 0 if the light has no depths; else a block has split × split texels of `lit`, and kGroup times
  /// as many of `dark` along each side.
  std::uint32_t split = 0;
  /// The length of one unit of distances (scene units); > 0.
  double unit = 0;
  /// No surface is nearer to the light than this (scene units).
  double clearance = 0;
  /// Texels of the horizon map that have a block, increasing.
  std::vector<std::uint32_t> blocks;
  /// Distances in units, block by block, row by row: surely no surface is nearer to the light than
  /// `lit`, whatever the horizon map says of the block; points farther than `dark` are in shadow.
  std::vector<std::uint16_t> lit, dark;

  std::uint32_t dark_split() const { return split * kGroup; }
  friend bool operator==(const LightDepths&, const LightDepths&) = default;
};

/// A cube map of distances from a light.
struct HorizonMap {
  /// Stands for an infinite distance.
  static constexpr std::uint16_t kNever = 0xFFFF;

  /// The length of one unit of distances (scene units); > 0.
  double unit = 1;
  /// The distance of each texel, in units; empty if the light has no horizon.
  std::vector<std::uint16_t> units;

  /// Stores distances ≥ 0 (scene units), one for each texel; each becomes shorter by at most a 65
  /// 000th of `reach`. Finite distances beyond `reach` are cut to it. A reach of 0 stands for a
  /// hundred times the nearest distance above 0. The map is empty if all distances are 0.
  static HorizonMap of(std::span<const float> distances, double reach);
  bool empty() const { return units.empty(); }
  double at(std::size_t texel) const { return units[texel] == kNever ? kInf : units[texel] * unit; }
  friend bool operator==(const HorizonMap&, const HorizonMap&) = default;
};

class LightHorizons {
 public:
  /// Texels along a side of a cube's face.
  static constexpr std::uint32_t kSide = 64;
  static constexpr std::size_t kTexels = cube_texels(kSide);
  /// Lights × objects beyond which looking for horizons costs more than it is likely to save.
  static constexpr std::uint64_t kMaxWork = 2'000'000;
  /// Distances from a light (scene units) that are known for a direction.
  struct Reach {
    /// No surface is nearer.
    double lit = 0;
    /// Points farther get no light; not to be used for rays that begin at t ≥ clearance / 2.
    double dark = kInf;
    double clearance = 0;
  };

  LightHorizons() = default;
  /// Takes a map for each light; a map has kTexels distances or none.
  explicit LightHorizons(std::vector<HorizonMap> maps) : LightHorizons(std::move(maps), {}) {}
  /// Takes depths for each light or an empty list; only lights that have a map have depths.
  LightHorizons(std::vector<HorizonMap> maps, std::vector<LightDepths> depths);
  /// Makes the horizons of a whole model. A light that something surrounds so closely that its map
  /// would be useless gets no map.
  static LightHorizons of(const Model& model);

  const std::vector<HorizonMap>& maps() const { return maps_; }
  const std::vector<LightDepths>& depths() const { return depths_; }
  /// True when no light has a map.
  bool is_empty() const;

  /// The distances known for a unit direction from a light.
  Reach toward(std::size_t light, const Vec3& direction) const;
  /// The horizon alone.
  double distance(std::size_t light, const Vec3& direction) const {
    return toward(light, direction).lit;
  }
  /// The distance from the light (scene units) up to which horizons matter: that of the farthest
  /// corner of all bounded objects' bounds; 0 if no object is bounded.
  static double reach_of(const Model& model, const PointLight& light);
  bool has_depths(std::size_t light) const {
    return light < block_of_.size() && !block_of_[light].empty();
  }
  /// Looks up distance(light, …) for each of `texels`, from the map alone, without depths; there
  /// must be at most as many texels as `distances` holds.
  void distances_at(std::size_t light, std::span<const std::uint32_t> texels,
                    std::span<float> distances) const {
    if (light >= maps_.size() || maps_[light].empty()) {
      std::fill_n(distances.begin(), texels.size(), 0.0f);
      return;
    }
    const HorizonMap& map = maps_[light];
    const auto unit = static_cast<float>(map.unit);
    for (std::size_t i = 0; i < texels.size(); ++i) {
      const std::uint16_t units = map.units[texels[i]];
      distances[i] = units == HorizonMap::kNever ? kFloatInf : unit * static_cast<float>(units);
    }
  }

 private:
  static constexpr std::uint16_t kNoBlock = 0xFFFF;
  static_assert(kTexels < kNoBlock);

  std::vector<HorizonMap> maps_;
  std::vector<LightDepths> depths_;
  /// For each light (with depths) and texel of its map, the number of its block or kNoBlock.
  std::vector<std::vector<std::uint16_t>> block_of_;
};

inline LightHorizons::LightHorizons(std::vector<HorizonMap> maps, std::vector<LightDepths> depths)
    : maps_(std::move(maps)), depths_(std::move(depths)), block_of_(depths_.size()) {
  for (std::size_t light = 0; light < depths_.size(); ++light) {
    const auto& blocks = depths_[light].blocks;
    if (blocks.empty()) continue;
    block_of_[light].assign(kTexels, kNoBlock);
    for (std::size_t i = 0; i < blocks.size(); ++i)
      block_of_[light][blocks[i]] = static_cast<std::uint16_t>(i);
  }
}

inline LightHorizons::Reach LightHorizons::toward(std::size_t light, const Vec3& direction) const {
  if (light >= maps_.size() || maps_[light].empty()) return {};
  const CubePlace place = cube_place(direction);
  const double i = place.u * kSide, j = place.v * kSide;
  const std::uint32_t column = cell_at(i, kSide), row = cell_at(j, kSide);
  const std::size_t texel = (place.face * kSide + row) * kSide + column;
  const std::uint16_t block = has_depths(light) ? block_of_[light][texel] : kNoBlock;
  if (block == kNoBlock) return {maps_[light].at(texel)};
  const LightDepths& depths = depths_[light];
  const auto at = [&](std::uint32_t split) {
    return (std::size_t{block} * split + cell_at((j - row) * split, split)) * split +
           cell_at((i - column) * split, split);
  };
  const std::uint16_t dark = depths.dark[at(depths.dark_split())];
  Reach reach{depths.lit[at(depths.split)] * depths.unit};
  if (dark != LightDepths::kNever) reach.dark = dark * depths.unit;
  reach.clearance = depths.clearance;
  return reach;
}

}  // namespace graycube
