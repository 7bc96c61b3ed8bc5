// Crossings found by walking the linked leaf regions of a BSP.
#pragma once

#include <utility>

#include "crossings/bsp.hpp"
#include "subdivisions/leaf_entry.hpp"
#include "subdivisions/pieces.hpp"
#include "subdivisions/subdivision.hpp"

namespace graycube {

class LinkedCells {
 public:
  explicit LinkedCells(const Model& model, Entry entry = Entry::kDescent,
                       const BspOptions& options = {})
      : bsp_(Bsp::build(model, options)), outermost_(bsp_), entry_(entry) {}

  /// As pieces.hpp says.
  template <typename Visit>
  bool walk(const Ray& ray, double t0, double t1, Mailbox& mailbox, Visit&& visit) const {
    const PlaneOrder order(ray);
    const BspLeaf& first = entry_ == Entry::kExtremal
                               ? outermost_.enter(bsp_, order, t0, mailbox.counts)
                               : leaf_at(bsp_, 0, order, t0, mailbox.counts);
    return walk_links(bsp_, order, first, t0, t1, mailbox.counts,
                      [&](const BspLeaf& leaf, double from, double to) {
                        return visit(CellPiece(bsp_.cell_programs(), leaf.programs(), ray, mailbox),
                                     from, to);
                      });
  }

  const Model& model() const { return bsp_.model(); }
  const Bsp& bsp() const { return bsp_; }
  std::size_t cell_count() const { return bsp_.leaves().size(); }
  std::size_t memory_bytes() const { return bsp_.memory_bytes(); }

 private:
  Bsp bsp_;
  OutermostLeaves outermost_;
  Entry entry_;
};

}  // namespace graycube
