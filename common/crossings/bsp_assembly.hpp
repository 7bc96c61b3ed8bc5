// Puts a Bsp together from the cuts that a builder chooses, and links its leaf regions.
#pragma once

#include <array>
#include <cstdint>

#include "crossings/bsp.hpp"

namespace graycube {

/// Begins with one node, number 0, which is all of space. Each node must be either cut or closed,
/// once.
class BspAssembly {
 public:
  explicit BspAssembly(const Model& model) : bsp_(model) { bsp_.nodes_.emplace_back(); }

  /// Cuts a node's cell by a plane; returns the index of the lower child, which the upper follows.
  std::uint32_t cut(std::uint32_t node, int axis, double at);
  /// Makes a node a leaf region.
  void close(std::uint32_t node, const Aabb& cell, const CellContent& content);
  /// Links the leaf regions, and gives the whole away.
  Bsp finish();

 private:
  void link(const std::array<std::uint32_t, 6>& outer, std::uint32_t node);
  std::uint32_t narrowed(std::uint32_t node, int face, const Aabb& cell) const;

  Bsp bsp_;
};

}  // namespace graycube
