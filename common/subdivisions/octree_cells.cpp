#include "subdivisions/octree_cells.hpp"

#include <utility>

#include "subdivisions/halving.hpp"

namespace graycube {

static_assert(kMostHalvings < kMostNameDigits);

OctreeCells::OctreeCells(const Model& model) : OctreeCells(model, CellContent{}) {}

OctreeCells::OctreeCells(const Model& model, CellContent inside)
    : space_(model, true, inside), max_depth_(halvings_for(inside.literal_count())) {
  subdivide(kRootName, space_.box(), inside, 0);
}

void OctreeCells::subdivide(CellName name, const Aabb& cell, const CellContent& content,
                            int depth) {
  if (content.items().empty()) return;
  const bool is_cut = depth < max_depth_ && content.literal_count() > kFewPrimitives;
  if (!is_cut) {
    table_.add({name, space_.add(content), false});
    ++leaf_count_;
    return;
  }
  table_.add({name, {}, true});
  for (unsigned part = 0; part < 8; ++part) {
    const Aabb box = part_box(cell, part);
    subdivide(part_of(name, part), box, restricted_to(content, model(), box), depth + 1);
  }
}

Aabb OctreeCells::part_box(const Aabb& cell, unsigned part) {
  Aabb box = cell;
  for (int a = 0; a < 3; ++a) {
    const double middle = 0.5 * (cell.lo[a] + cell.hi[a]);
    ((part >> a & 1u) != 0 ? box.lo : box.hi)[a] = middle;
  }
  return box;
}

}  // namespace graycube
