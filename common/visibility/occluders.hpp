// What may stand between the surfaces of macro-regions and the lights: by light and texel of the
// cube map about it, the objects that show there. A node that holds those that its own surfaces ask
// for finishes its shadow rays itself, and its foreign horizons, those of the objects that it does
// not hold, tell it when it may.
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
  /// So many ask for it.
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

  /// Of a whole model; empty where LightHorizons::kMaxWork or kMostEntries would be passed.
  static Occluders of(const Model& model);

  bool is_empty() const { return lights_.empty(); }
  /// The nearest first.
  std::span<const Entry> at(std::size_t light, std::uint32_t texel) const {
    const OfLight& l = lights_[light];
    return std::span(l.entries).subspan(l.first[texel], l.first[texel + 1] - l.first[texel]);
  }
  /// Those of all objects, as LightHorizons::of has them.
  LightHorizons horizons() const;
  /// Of what a node does not hold whole, and of the parts that it does hold: these have other
  /// surfaces beyond its macro-regions than the objects that they are of. `model` is the whole one.
  LightHorizons foreign_horizons(const ModelContents& contents, const Model& model) const;

 private:
  /// By light and texel, where the nearest of the objects that are not held (by index) begins.
  std::vector<std::vector<float>> foreign_distances(const std::vector<bool>& is_held) const;

  struct OfLight {
    /// LightHorizons::reach_of.
    double reach = 1;
    /// By texel, and one more: where its entries begin.
    std::vector<std::uint32_t> first;
    std::vector<Entry> entries;
  };
  std::vector<OfLight> lights_;
  std::size_t objects_ = 0;
};

/// What a node is to hold beside `is_held` (by object), chosen for the most rays that it can finish
/// by the byte: those objects that `queries` ask for, until their `bytes` (by object) add up to
/// `room`. Sets is_held.
void choose_occluders(const Occluders& occluders, std::span<const OccluderQuery> queries,
                      std::span<const std::size_t> bytes, std::size_t room,
                      std::vector<bool>& is_held);

}  // namespace graycube
