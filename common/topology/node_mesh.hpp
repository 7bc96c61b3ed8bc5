// The mesh of macro-regions, as it lies on the hypercube: which node owns which column, row and
// slab.
#pragma once

#include <cstdint>

#include "topology/hypercube.hpp"

namespace graycube {

/// Which mesh nodes form, and along which links slices come and light is added up.
enum class MeshMode : std::uint8_t {
  k2d,    ///< columns × rows; each node deals with the frontal itself
  k3d,    ///< columns × rows × slabs in depth
  kRing,  ///< columns only; slices and sums along the Gray code's ring
  kTree   ///< columns × rows; slices and sums along the hypercube's binomial tree
};

/// The d bits of a node's label are shared out among up to three Gray codes, so that neighbours in
/// each direction differ in one bit: those of the column are the lowest, those of the slab the
/// highest. A 2D mesh has ⌈d/2⌉ bits for columns; in a 3D mesh slabs have ⌊d/3⌋, and columns the
/// larger half of the others: 8 nodes are 2 × 2 × 2, 16 are 4 × 2 × 2, 64 are 4 × 4 × 4. A ring has
/// columns only.
class NodeMesh {
 public:
  /// A node's place: 0 … columns − 1, 0 … rows − 1, 0 … slabs − 1.
  struct Place {
    std::uint32_t column = 0, row = 0, slab = 0;
    friend bool operator==(const Place&, const Place&) = default;
  };

  NodeMesh(const Hypercube& cube, MeshMode mode = MeshMode::k2d);  // NOLINT: implicit

  const Hypercube& cube() const { return cube_; }
  std::uint32_t columns() const { return 1u << column_bits_; }
  std::uint32_t rows() const { return 1u << row_bits_; }
  std::uint32_t slabs() const { return 1u << slab_bits_; }

  Place place_of(Rank rank) const;
  /// The node that owns a macro-region. A scattered grid has several times as many columns and rows
  /// as the mesh; nodes of neighbouring regions are linked or the same.
  Rank owner_of(std::uint32_t region_column, std::uint32_t region_row,
                std::uint32_t region_slab = 0) const;

 private:
  Hypercube cube_;
  std::uint32_t column_bits_, row_bits_, slab_bits_;
};

}  // namespace graycube
