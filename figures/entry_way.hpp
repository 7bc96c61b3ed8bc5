// How rays from neighbours find their entry region: the report's figure 8, from rays of a run.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "figures/leaf_space.hpp"
#include "figures/run_record.hpp"

namespace graycube::figures {

/// The leaf regions that a ray passes, as nodes of the BSP, from an outermost one to the one that
/// it is in at its parameter t, by links.
std::vector<std::uint32_t> entry_way(const LeafSpace& space, const RayTask& ray);

/// The node that the link leads to by which a way goes on from one leaf region to another: the root
/// of a subtree, below which planes are compared.
std::uint32_t subtree_between(const LeafSpace& space, std::uint32_t leaf, std::uint32_t next);

/// A received ray, the model of the node that received it, and its way there.
struct ShownEntry {
  ReceivedRay received;
  std::shared_ptr<const Model> model;
  std::shared_ptr<const LeafSpace> space;
  std::vector<std::uint32_t> way;
};

/// Ways of more leaf regions than this aren't legible.
inline constexpr std::size_t kMostOnWay = 7;

/// Among the rays recorded, one with the longest legible way; among those, one that is amid the
/// scene. `slices` are the nodes' parts of the scene as prepared, by rank, or one for all. Nothing
/// if no ray was received that can be drawn: for `arnaldi` it must be in front of the eye.
std::optional<ShownEntry> choose_entry(const RunRecord& run, const std::vector<SharedBytes>& slices,
                                       Subdivision way);

}  // namespace graycube::figures
