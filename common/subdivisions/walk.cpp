#include "subdivisions/walk.hpp"

#include <algorithm>

namespace graycube {

std::optional<Crossing> first_crossing(const Bsp& bsp, const Ray& ray, double t0, double t1,
                                       Mailbox& mailbox) {
  std::optional<Crossing> found;
  walk(bsp, ray, t0, t1, mailbox, [&](const BspLeaf& leaf, double from, double to) {
    double before = to;
    for (std::uint32_t i = 0; i < leaf.program_count; ++i) {
      const CellProgram& program = bsp.programs()[leaf.first_program + i];
      for_each_crossing(bsp, program, ray, from, before, mailbox, [&](const Crossing& c) {
        found = c;
        before = c.t;
        return false;
      });
    }
    return !found.has_value();
  });
  return found;
}

bool pass_light(const Bsp& bsp, const Ray& ray, double t0, double t1, Mailbox& mailbox,
                Rgb& light) {
  struct Pane {
    double t;
    double transmit;
  };
  std::vector<Pane> panes;  // stays empty, and unallocated, where nothing is transparent
  const Model& model = bsp.model();
  return walk(bsp, ray, t0, t1, mailbox, [&](const BspLeaf& leaf, double from, double to) {
    panes.clear();
    for (std::uint32_t i = 0; i < leaf.program_count; ++i) {
      const CellProgram& program = bsp.programs()[leaf.first_program + i];
      const bool open =
          for_each_crossing(bsp, program, ray, from, to, mailbox, [&](const Crossing& c) {
            const double transmit =
                model.materials[model.primitives[c.primitive].material].transmit;
            if (transmit > 0) panes.push_back({c.t, transmit});
            return transmit > 0;
          });
      if (!open) return false;
    }
    std::stable_sort(panes.begin(), panes.end(),
                     [](const Pane& a, const Pane& b) { return a.t < b.t; });
    for (const Pane& pane : panes) light = pane.transmit * light;
    return true;
  });
}

}  // namespace graycube
