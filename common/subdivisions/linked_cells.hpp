// Crossings found by walking the linked leaf regions of a BSP.
#pragma once

#include "crossings/bsp.hpp"
#include "subdivisions/crossing_search.hpp"

namespace graycube {

class LinkedCells : public CrossingSearch {
 public:
  explicit LinkedCells(const Model& model) : bsp_(Bsp::build(model)) {}

  std::optional<Crossing> first_crossing(const Ray& ray, double t0, double t1,
                                         Mailbox& mailbox) const override;
  bool pass_light(const Ray& ray, double t0, double t1, Mailbox& mailbox,
                  Rgb& light) const override;
  std::size_t cell_count() const override { return bsp_.leaves().size(); }
  std::size_t memory_bytes() const override { return bsp_.memory_bytes(); }

 private:
  Bsp bsp_;
};

}  // namespace graycube
