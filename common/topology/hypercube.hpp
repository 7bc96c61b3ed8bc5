// The hypercube of nodes, the torus of macro-regions that lies on it, the token's ring, and the
// tree of sums.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "topology/rank.hpp"

namespace graycube {

inline constexpr std::uint32_t kMaxDimension = 10;
inline constexpr std::uint32_t kMaxNodes = 1u << kMaxDimension;

/// Dimension d: a grid of 2^⌈d/2⌉ columns and 2^⌊d/2⌋ rows. Both are numbered by cyclic Gray codes,
/// so that neighbours on the torus are linked and rays are never routed.
class Hypercube {
 public:
  /// Nothing unless `nodes` is a power of two, 1 … kMaxNodes.
  static std::optional<Hypercube> of_size(std::uint64_t nodes);

  std::uint32_t dimension() const { return column_bits_ + row_bits_; }
  std::uint32_t nodes() const { return 1u << dimension(); }
  std::uint32_t columns() const { return 1u << column_bits_; }
  std::uint32_t rows() const { return 1u << row_bits_; }
  bool has(Rank rank) const { return rank.value < nodes(); }

  /// Ranks, labels, columns and rows given below must be in range.
  Rank rank_at(std::uint32_t column, std::uint32_t row) const;
  std::uint32_t column_of(Rank rank) const;
  std::uint32_t row_of(Rank rank) const;
  /// gray(row) above gray(column).
  GrayLabel label_of(Rank rank) const;
  Rank rank_of(GrayLabel label) const;

  /// The node at the other end of the link across a bit, 0 ≤ bit < dimension.
  Rank neighbour(Rank rank, std::uint32_t bit) const;
  /// The bit across which two nodes are linked; nothing when they are not.
  std::optional<std::uint32_t> link_between(Rank a, Rank b) const;

  /// The first bit on the way from one node to another, which is as many links away as their labels
  /// differ in bits; `but` is taken only when it is the last. They must not be the same node.
  std::uint32_t first_bit(Rank from, Rank to,
                          std::optional<std::uint32_t> but = std::nullopt) const;

  /// The Gray-code Hamiltonian cycle 0 → … → 0 over links; on one node itself.
  Rank ring_next(Rank rank) const;
  Rank ring_previous(Rank rank) const;

  /// The binomial spanning tree rooted at rank 0, over links; nothing for the root.
  std::optional<Rank> tree_parent(Rank rank) const;
  std::vector<Rank> tree_children(Rank rank) const;

  /// The node that a macro-region belongs to; a scattered grid has several times as many columns
  /// and rows as the hypercube's, and neighbours on it are linked or the same node.
  Rank owner_of(std::uint32_t region_column, std::uint32_t region_row) const;

 private:
  explicit Hypercube(std::uint32_t dimension)
      : column_bits_((dimension + 1) / 2), row_bits_(dimension / 2) {}
  Rank ring_step(Rank rank, std::uint32_t steps) const;

  std::uint32_t column_bits_, row_bits_;
};

}  // namespace graycube
