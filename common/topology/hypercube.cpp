#include "topology/hypercube.hpp"

#include <bit>

#include "check.hpp"
#include "topology/gray.hpp"
#include "topology/hilbert.hpp"

namespace graycube {

std::optional<Hypercube> Hypercube::of_size(std::uint64_t nodes) {
  if (nodes > kMaxNodes || !std::has_single_bit(nodes)) return std::nullopt;
  return Hypercube(static_cast<std::uint32_t>(std::countr_zero(nodes)));
}

// There are as many columns as rows, or twice as many: two squares side by side, and the curve
// through the first ends beside the second.

Rank Hypercube::rank_at(std::uint32_t column, std::uint32_t row) const {
  GRAYCUBE_CHECK(column < columns() && row < rows(), "column %u, row %u", column, row);
  const std::uint32_t square = column >> row_bits_;
  return {square << 2 * row_bits_ | hilbert_number(rows(), {column & (rows() - 1), row})};
}

std::uint32_t Hypercube::column_of(Rank rank) const {
  GRAYCUBE_CHECK(has(rank), "rank %u of %u", rank.value, nodes());
  const std::uint32_t square = rank.value >> 2 * row_bits_;
  return square << row_bits_ | hilbert_cell(rows(), rank.value).column;
}

std::uint32_t Hypercube::row_of(Rank rank) const {
  GRAYCUBE_CHECK(has(rank), "rank %u of %u", rank.value, nodes());
  return hilbert_cell(rows(), rank.value).row;
}

GrayLabel Hypercube::label_of(Rank rank) const {
  return {(gray_code(row_of(rank)) << column_bits_) | gray_code(column_of(rank))};
}

Rank Hypercube::rank_of(GrayLabel label) const {
  GRAYCUBE_CHECK(label.value < nodes(), "label %u of %u", label.value, nodes());
  return rank_at(gray_rank(label.value & (columns() - 1)), gray_rank(label.value >> column_bits_));
}

Rank Hypercube::neighbour(Rank rank, std::uint32_t bit) const {
  GRAYCUBE_CHECK(bit < dimension(), "bit %u in dimension %u", bit, dimension());
  return rank_of({label_of(rank).value ^ (1u << bit)});
}

std::optional<std::uint32_t> Hypercube::link_between(Rank a, Rank b) const {
  const std::uint32_t difference = label_of(a).value ^ label_of(b).value;
  if (!std::has_single_bit(difference)) return std::nullopt;
  return static_cast<std::uint32_t>(std::countr_zero(difference));
}

Rank Hypercube::ring_step(Rank rank, std::uint32_t steps) const {
  const std::uint32_t position = gray_rank(label_of(rank).value) + steps;
  return rank_of({gray_code(position & (nodes() - 1))});
}

std::uint32_t Hypercube::first_bit(Rank from, Rank to, std::optional<std::uint32_t> but) const {
  const std::uint32_t differing = label_of(from).value ^ label_of(to).value;
  GRAYCUBE_CHECK(differing != 0, "node %u is where it is", from.value);
  const std::uint32_t others = but ? differing & ~(1u << *but) : differing;
  return static_cast<std::uint32_t>(std::countr_zero(others != 0 ? others : differing));
}

Rank Hypercube::ring_next(Rank rank) const { return ring_step(rank, 1); }
Rank Hypercube::ring_previous(Rank rank) const { return ring_step(rank, nodes() - 1); }

std::optional<Rank> Hypercube::tree_parent(Rank rank) const {
  const std::uint32_t label = label_of(rank).value;
  if (label == 0) return std::nullopt;
  return rank_of({label & (label - 1)});
}

std::vector<Rank> Hypercube::tree_children(Rank rank) const {
  const std::uint32_t label = label_of(rank).value;
  const std::uint32_t free_bits =
      label == 0 ? dimension() : static_cast<std::uint32_t>(std::countr_zero(label));
  std::vector<Rank> children;
  for (std::uint32_t bit = 0; bit < free_bits; ++bit) {
    children.push_back(rank_of({label | (1u << bit)}));
  }
  return children;
}

}  // namespace graycube
