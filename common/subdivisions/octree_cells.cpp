#include "subdivisions/octree_cells.hpp"

#include <utility>

namespace graycube {

static_assert(kMostHalvings < kMostNameDigits);

OctreeCells::OctreeCells(const Model& model) : OctreeCells(model, CellContent{}) {}

OctreeCells::OctreeCells(const Model& model, CellContent inside) : space_(model, true, inside) {
  const int max_depth = halvings_for(inside.literal_count());
  halve(
      {kRootName, space_.box(), 0, std::move(inside)}, 8, max_depth,
      [&](const HalvedCell& cell, auto&& add) { cut(cell, add); },
      [&](const HalvedCell& cell) {
        if (cell.content.items().empty()) return;
        table_.add({cell.place, space_.add(cell.content), false});
        ++leaf_count_;
      });
}

template <typename Add>
void OctreeCells::cut(const HalvedCell& cell, Add&& add) {
  table_.add({cell.place, {}, true});
  for (unsigned part = 0; part < 8; ++part) {
    const Aabb box = part_box(cell.box, part);
    add(HalvedCell{part_of(cell.place, part), box, cell.depth + 1,
                   restricted_to(cell.content, model(), box)});
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
