// Objects that may stand between the surfaces of macro-regions and the lights: for each light and
// texel of the cube map around it, the objects that show there. A node that holds those for which
// its own surfaces ask finishes its shadow rays itself; its foreign horizons, those of the objects
// that it does not hold, tell it when it may.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "csg/model.hpp"
#include "regions/restrict.hpp"
#include "visibility/light_horizons.hpp"

namespace graycube {

/// Shadow rays ask for all objects of a texel that begin nearer to the light than where they leave
/// the macro-regions of their node.
struct OccluderQuery {
  std::uint32_t light = 0;
  std::uint32_t texel = 0;
  double distance = 0;
  /// The number of shadow rays that ask for this.
  std::uint32_t rays = 1;
};

class Occluders {
 public:
  struct Entry {
    float begin;
    /// Index into the model's objects.
    std::uint32_t object;
  };
  /// Entries beyond which lists cost more memory and time than they are likely to save.
  static constexpr std::size_t kMostEntries = std::size_t{1} << 22;

  /// Occluders of a whole model; empty if LightHorizons::kMaxWork or kMostEntries would be passed.
  static Occluders of(const Model& model);

  bool is_empty() const { return lights_.empty(); }
  /// The objects that show in a texel, the nearest first.
  std::span<const Entry> at(std::size_t light, std::uint32_t texel) const {
    const OfLight& l = lights_[light];
    return std::span(l.entries).subspan(l.first[texel], l.first[texel + 1] - l.first[texel]);
  }
  /// The horizons of all objects, the same as LightHorizons::of() makes.
  LightHorizons horizons() const;
  /// The horizons of objects that a node does not hold whole, and of the parts that it holds:
  /// beyond its macro-regions a part has other surfaces than its object. `model` is the whole one.
  LightHorizons foreign_horizons(const ModelContents& contents, const Model& model) const;

 private:
  /// For each light and texel, the distance at which the nearest object that is not held begins.
  std::vector<std::vector<float>> foreign_distances(const std::vector<bool>& is_held) const;

  struct OfLight {
    /// See LightHorizons::reach_of() (scene units).
    double reach = 1;
    /// Index of the first entry of each texel, and, last, the number of entries.
    std::vector<std::uint32_t> first;
    std::vector<Entry> entries;
  };
  std::vector<OfLight> lights_;
  std::size_t objects_ = 0;
};

/// Chooses objects that a node is to hold in addition to those in `is_held`, and adds them to it:
/// of the objects that `queries` ask for, those that let it finish the most rays for each byte,
/// until they fill `room` bytes. `bytes` and `is_held` are indexed by object.
void choose_occluders(const Occluders& occluders, std::span<const OccluderQuery> queries,
                      std::span<const std::size_t> bytes, std::size_t room,
                      std::vector<bool>& is_held);

}  // namespace graycube
