// What `--algorithm auto` decides, from sizes alone: the scene, the picture, the nodes, their
// hosts.
#pragma once

#include <cstdint>

#include "proto/messages.hpp"

namespace graycube {

/// `roth` copies the scene to every node; `auto` picks it only when a node's copy stays below this.
inline constexpr std::uint64_t kReplicatedModelBytes = std::uint64_t{512} << 20;

/// What is decided about.
struct ChoiceBasis {
  std::uint64_t model_bytes = 0, primary_rays = 0;
  /// Hosts that the nodes lie on. With more than one, what the frontal sends is ciphered and goes
  /// through its one network card.
  std::uint32_t nodes = 1, hosts = 1;
};

/// Seconds until the frontal has sent all nodes of several hosts the whole scene: it ciphers each
/// node's copy, one after another. 0 on one host, where copies cost next to nothing.
double copying_s(const ChoiceBasis& basis);

/// kMacro if a mesh of macro-regions is asked for, if the scene is too large for every node, or if
/// on several hosts copying it would take longer than roth's even shares can gain; else kRoth.
Algorithm chosen_algorithm(MeshMode mesh, const ChoiceBasis& basis);

}  // namespace graycube
