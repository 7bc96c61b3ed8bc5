// The hypercube of nodes, the torus of its columns and rows, the token's ring, and the binomial
// tree.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "topology/rank.hpp"

namespace graycube {

inline constexpr std::uint32_t kMaxDimension = 10;
inline constexpr std::uint32_t kMaxNodes = 1u << kMaxDimension;

/// A hypercube of dimension d: 2^⌈d/2⌉ columns and 2^⌊d/2⌋ rows, both in cyclic Gray codes, so that
/// neighbours on the torus are linked. Aligned blocks of 2^a ranks are compact, and subcubes.
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
  /// The bits of the row's Gray code, followed by those of the column's as the lower ones.
  GrayLabel label_of(Rank rank) const;
  Rank rank_of(GrayLabel label) const;

  /// The node at the other end of the link across a bit, 0 ≤ bit < dimension.
  Rank neighbour(Rank rank, std::uint32_t bit) const;
  /// The bit across which two nodes are linked; nothing when they are not.
  std::optional<std::uint32_t> link_between(Rank a, Rank b) const;

  /// The bit of the first link from one node towards another, which is as many links away as their
  /// labels differ in bits; `but` is taken only if it is the last. The nodes must differ.
  std::uint32_t first_bit(Rank from, Rank to,
                          std::optional<std::uint32_t> but = std::nullopt) const;

  /// The next node on the Gray-code Hamiltonian cycle 0 → … → 0 over links; itself if alone.
  Rank ring_next(Rank rank) const;
  Rank ring_previous(Rank rank) const;

  /// The parent in the binomial spanning tree over links, rooted at rank 0; nothing for the root.
  std::optional<Rank> tree_parent(Rank rank) const;
  std::vector<Rank> tree_children(Rank rank) const;

 private:
  explicit Hypercube(std::uint32_t dimension)
      : column_bits_((dimension + 1) / 2), row_bits_(dimension / 2) {}
  Rank ring_step(Rank rank, std::uint32_t steps) const;

  std::uint32_t column_bits_, row_bits_;
};

}  // namespace graycube
