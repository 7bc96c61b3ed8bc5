#include "subdivisions/kaplan_cells.hpp"

#include <utility>

#include "subdivisions/halving.hpp"

namespace graycube {

KaplanCells::KaplanCells(const Model& model) : KaplanCells(model, CellContent{}) {}

KaplanCells::KaplanCells(const Model& model, CellContent inside)
    : space_(model, false, inside),
      nodes_(1),
      max_depth_(3 * halvings_for(inside.literal_count())) {
  subdivide(0, space_.box(), std::move(inside), 0);
}

void KaplanCells::subdivide(std::uint32_t node, const Aabb& cell, CellContent content, int depth) {
  if (depth >= max_depth_ || content.literal_count() <= kFewPrimitives) {
    nodes_[node] = {0, static_cast<std::uint32_t>(leaves_.size()), BspNode::kLeafAxis};
    leaves_.push_back(space_.add(content));
    return;
  }
  const int axis = depth % 3;
  const double at = 0.5 * (cell.lo[axis] + cell.hi[axis]);
  Aabb lower = cell;
  lower.hi[axis] = at;
  Aabb upper = cell;
  upper.lo[axis] = at;
  CellContent below = restricted_to(content, model(), lower);
  CellContent above = restricted_to(content, model(), upper);
  content = {};
  const auto child = static_cast<std::uint32_t>(nodes_.size());
  nodes_.resize(nodes_.size() + 2);
  nodes_[node] = {at, child, static_cast<std::uint8_t>(axis)};
  subdivide(child, lower, std::move(below), depth + 1);
  subdivide(child + 1, upper, std::move(above), depth + 1);
}

std::size_t KaplanCells::memory_bytes() const {
  return space_.memory_bytes() + nodes_.capacity() * sizeof(BspNode) +
         leaves_.capacity() * sizeof(ProgramRange);
}

}  // namespace graycube
