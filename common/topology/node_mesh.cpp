#include "topology/node_mesh.hpp"

#include "check.hpp"
#include "topology/gray.hpp"

namespace graycube {

NodeMesh::NodeMesh(const Hypercube& cube, MeshMode mode) : cube_(cube) {
  const std::uint32_t bits = cube.dimension();
  slab_bits_ = mode == MeshMode::k3d ? bits / 3 : 0;
  column_bits_ = mode == MeshMode::kRing ? bits : (bits - slab_bits_ + 1) / 2;
  row_bits_ = bits - slab_bits_ - column_bits_;
}

NodeMesh::Place NodeMesh::place_of(Rank rank) const {
  const std::uint32_t label = cube_.label_of(rank).value;
  return {gray_rank(label & (columns() - 1)), gray_rank(label >> column_bits_ & (rows() - 1)),
          gray_rank(label >> (column_bits_ + row_bits_))};
}

Rank NodeMesh::owner_of(std::uint32_t region_column, std::uint32_t region_row,
                        std::uint32_t region_slab) const {
  const std::uint32_t column = region_column & (columns() - 1), row = region_row & (rows() - 1);
  // Ranks are numbered by the columns and rows of 2D meshes.
  if (columns() == cube_.columns() && slab_bits_ == 0) return cube_.rank_at(column, row);
  GRAYCUBE_CHECK(region_slab < slabs(), "slab %u of %u", region_slab, slabs());
  const std::uint32_t slab_and_row = gray_code(region_slab) << row_bits_ | gray_code(row);
  return cube_.rank_of({slab_and_row << column_bits_ | gray_code(column)});
}

}  // namespace graycube
