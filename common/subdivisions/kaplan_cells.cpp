#include "subdivisions/kaplan_cells.hpp"

#include <utility>

namespace graycube {

KaplanCells::KaplanCells(const Model& model) : KaplanCells(model, CellContent{}) {}

KaplanCells::KaplanCells(const Model& model, CellContent inside)
    : space_(model, false, inside), nodes_(1) {
  const int max_depth = 3 * halvings_for(inside.literal_count());
  halve(
      {0, space_.box(), 0, std::move(inside)}, 2, max_depth,
      [&](const HalvedCell& cell, auto&& add) { cut(cell, add); },
      [&](const HalvedCell& cell) {
        nodes_[cell.place] = {0, static_cast<std::uint32_t>(leaves_.size()), BspNode::kLeafAxis};
        leaves_.push_back(space_.add(cell.content));
      });
}

template <typename Add>
void KaplanCells::cut(const HalvedCell& cell, Add&& add) {
  const int axis = cell.depth % 3;
  const double at = 0.5 * (cell.box.lo[axis] + cell.box.hi[axis]);
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[cell.place] = {at, child, static_cast<std::uint8_t>(axis)};
  for (const unsigned part : {0u, 1u}) {
    Aabb box = cell.box;
    (part == 1 ? box.lo : box.hi)[axis] = at;
    add(HalvedCell{child + part, box, cell.depth + 1, restricted_to(cell.content, model(), box)});
  }
}

std::size_t KaplanCells::memory_bytes() const {
  return space_.memory_bytes() + nodes_.capacity() * sizeof(BspNode) +
         leaves_.capacity() * sizeof(ProgramRange);
}

}  // namespace graycube
